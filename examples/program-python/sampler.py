"""A sampler for carlo validate --command "python3 sampler.py" --domain disk: uniform points of the unit disk.

With --uniforms own carlo asks for one sample of each of several seeds, as from a rejection sampler."""
import array
import math
import random
import sys


def sample(u):
    r, phi = math.sqrt(u[0]), 2 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi)


def draw(seed):
    numbers = random.Random(int(seed[0]))
    while True:
        x, y = numbers.uniform(-1, 1), numbers.uniform(-1, 1)
        if x * x + y * y <= 1:
            return x, y


def pdf(x):
    return (1 / math.pi,)


def answer(question, source, sink):
    what, rows, width = question.split()
    rows, width = int(rows), int(width)
    function = {b"sample": sample, b"draw": draw, b"pdf": pdf}[what]
    numbers = array.array("d")
    numbers.frombytes(source.read(8 * rows * width))
    results = array.array("d")
    for at in range(0, rows * width, width):
        results.extend(function(numbers[at : at + width]))
    sink.write(results.tobytes())
    sink.flush()


for line in sys.stdin.buffer:
    answer(line, sys.stdin.buffer, sys.stdout.buffer)
