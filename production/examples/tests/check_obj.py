"""Looks over the OBJ file of teapot_obj: check_obj.py FILE SEGMENTS

Counts, unit normals that point outward, and one surface without cracks: its only edges with one triangle are the
openings that the teapot has, its lid and rim, and the ends of handle and spout.
"""
import collections
import math
import sys

name, n = sys.argv[1], int(sys.argv[2])
positions, normals, faces = [], [], []
for line in open(name):
    kind, *words = line.split()
    if kind == 'v':
        positions.append(tuple(map(float, words)))
    elif kind == 'vn':
        normals.append(tuple(map(float, words)))
    elif kind == 'f':
        faces.append([tuple(int(number) - 1 for number in word.split('//')) for word in words])


def expect(what, found, expected):
    if found != expected:
        sys.exit(f'{what}: {found}, expected {expected}')


def cross(p, q):
    return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]


# Around the axis there are 6 patches, one below the other; lid and bottom have a pole each. The tubes of handle and spout
# have 2 patches in length and 2 around. Lid and rim are not connected, nor are tubes and body, except for one point: the
# handle ends in (-2, 0, 0.9), where four patches of the body meet.
round_part = (1 + 2 * n * 4 * n) + (4 * n * 4 * n + 1)
tubes = 2 * (2 * n + 1) * 2 * n
expect('positions', len(positions), round_part + tubes - 1)
expect('normals', len(normals), 32 * (n + 1) ** 2)
expect('triangles', len(faces), 32 * 2 * n * n - 2 * 4 * n)
expect('distinct positions', len(set(positions)), len(positions))

edges = collections.Counter()
for face in faces:
    a, b, c = (corner[0] for corner in face)
    edges.update([(a, b), (b, c), (c, a)])
expect('edges with more than one triangle on a side', sum(count > 1 for count in edges.values()), 0)
open_edges = [edge for edge in edges if edge[::-1] not in edges]
expect('open edges', len(open_edges), 2 * 4 * n + 4 * 2 * n)

for face in faces:
    p, q, r = (positions[corner[0]] for corner in face)
    out = cross([q[i] - p[i] for i in range(3)], [r[i] - p[i] for i in range(3)])
    for corner in face:
        normal = normals[corner[1]]
        if abs(math.hypot(*normal) - 1) > 1e-6:
            sys.exit(f'not a unit normal: {normal}')
        if sum(a * b for a, b in zip(out, normal)) <= 0:
            sys.exit(f'normal {normal} on the other side of the triangle {p}, {q}, {r}')

# The volume of the model (which is not closed, because of the openings) and its area.
corners = [[positions[corner[0]] for corner in face] for face in faces]


volume = sum(sum(a * b for a, b in zip(p, cross(q, r))) / 6 for p, q, r in corners)
area = sum(math.hypot(*cross([q[i] - p[i] for i in range(3)], [r[i] - p[i] for i in range(3)])) / 2 for p, q, r in corners)
print(f'{len(positions)} positions, {len(faces)} triangles, {len(open_edges)} open edges, volume {volume:.6f}, area {area:.6f}')
if n == 10:
    expect('volume', f'{volume:.5f}', '25.77011')
    expect('area', f'{area:.5f}', '52.66079')
