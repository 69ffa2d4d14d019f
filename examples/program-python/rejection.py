"""A rejection sampler for carlo validate --command "python3 rejection.py" --uniforms own --domain disk.

It takes a varying number of random numbers, so carlo asks for one sample of each of several seeds."""
import array
import math
import random
import sys


def draw(seed):
    numbers = random.Random(int(seed))
    while True:
        x, y = numbers.uniform(-1, 1), numbers.uniform(-1, 1)
        if x * x + y * y <= 1:
            return x, y


def answer(question, source, sink):
    what, rows, width = question.split()
    rows, width = int(rows), int(width)
    numbers = array.array("d")
    numbers.frombytes(source.read(8 * rows * width))
    results = array.array("d")
    for at in range(0, rows * width, width):
        results.extend(draw(numbers[at]) if what == b"draw" else (1 / math.pi,))
    sink.write(results.tobytes())
    sink.flush()


for line in sys.stdin.buffer:
    answer(line, sys.stdin.buffer, sys.stdout.buffer)
