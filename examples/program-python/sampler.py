"""A sampler for carlo validate --command "python3 sampler.py" --domain disk: uniform points of the unit disk."""
import array
import math
import sys


def sample(u):
    r, phi = math.sqrt(u[0]), 2 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi)


def pdf(x):
    return (1 / math.pi,)


def answer(question, source, sink):
    what, rows, width = question.split()
    rows, width = int(rows), int(width)
    numbers = array.array("d")
    numbers.frombytes(source.read(8 * rows * width))
    results = array.array("d")
    for at in range(0, rows * width, width):
        results.extend((sample if what == b"sample" else pdf)(numbers[at : at + width]))
    sink.write(results.tobytes())
    sink.flush()


for line in sys.stdin.buffer:
    answer(line, sys.stdin.buffer, sys.stdout.buffer)
