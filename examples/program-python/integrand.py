"""An integrand for carlo integrate --command "python3 integrand.py" -d "x=0:1,y=0:2": x y^2, whose integral is 4/3."""
import array
import sys


def eval(x):
    return (x[0] * x[1] ** 2,)


for line in sys.stdin.buffer:
    what, rows, width = line.split()
    rows, width = int(rows), int(width)
    numbers = array.array("d")
    numbers.frombytes(sys.stdin.buffer.read(8 * rows * width))
    results = array.array("d")
    for at in range(0, rows * width, width):
        results.extend(eval(numbers[at : at + width]))
    sys.stdout.buffer.write(results.tobytes())
    sys.stdout.buffer.flush()
