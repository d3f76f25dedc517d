#!/usr/bin/env node
// An evaluator to be judged, normals included: evalcts vectors emit | node bezier.mjs | evalcts vectors check.
// De Casteljau's construction in JavaScript's numbers, which are binary64.
import { createInterface } from "node:readline";

// C's hexadecimal numbers: 0x1.8p-3.
function number(word) {
  const hexadecimal = /^(-?)0x([01])\.?([0-9a-f]*)p(.*)$/.exec(word);
  if (!hexadecimal) return Number(word);
  const [, sign, whole, digits, exponent] = hexadecimal;
  const scale = Number(exponent) - 4 * digits.length;
  // In two steps, because the power alone may be too small for a number.
  const half = Math.trunc(scale / 2);
  const magnitude = parseInt(whole + digits, 16) * 2 ** half * 2 ** (scale - half);
  return sign ? -magnitude : magnitude;
}

// The argument, or the point of a grid.
function coordinate(isGrid, next) {
  if (!isGrid) return next();
  const [segments, first, last, index] = [next(), next(), next(), next()];
  return index === segments ? last : index * ((last - first) / segments) + first;
}

// The value and the derivative of a curve of points with respect to t.
function construct(points, s, t) {
  let difference = points[0].map(() => 0);
  const degree = points.length - 1;
  while (points.length > 1) {
    if (points.length === 2) difference = points[1].map((x, c) => degree * (x - points[0][c]));
    points = points.slice(1).map((point, i) => point.map((x, c) => s * points[i][c] + t * x));
  }
  return [points[0], difference];
}

function unitNormal(p, pu, pv) {
  let [a, b] = [pu, pv];
  if (p.length === 4) [a, b] = [pu, pv].map((d) => d.map((x, c) => p[3] * x - d[3] * p[c]));
  const largest = Math.max(...a.map(Math.abs), ...b.map(Math.abs)) || 1;
  [a, b] = [a, b].map((vector) => vector.map((x) => x / largest));
  const m = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const length = Math.hypot(...m);
  return length > 0 ? m.map((x) => x / length) : null;
}

function answer(kind, words) {
  const next = () => number(words.shift());
  const isGrid = kind.startsWith("grid");
  const isNormal = kind.endsWith("normal");
  const two = isNormal || kind.endsWith("2");
  const [k, uOrder, vOrder] = [next(), next(), two ? next() : 1];
  const [u1, u2, v1, v2] = [next(), next(), two ? next() : 0, two ? next() : 1];
  const u = coordinate(isGrid, next);
  const v = two ? coordinate(isGrid, next) : 0;
  const values = words.map(number);
  const point = (i, j) => values.slice((i * vOrder + j) * k, (i * vOrder + j + 1) * k);
  const rows = Array.from({ length: uOrder }, (_, i) => {
    const row = Array.from({ length: vOrder }, (_, j) => point(i, j));
    return construct(row, (v2 - v) / (v2 - v1), (v - v1) / (v2 - v1));
  });
  const [s, t] = [(u2 - u) / (u2 - u1), (u - u1) / (u2 - u1)];
  const [p, pu] = construct(rows.map((row) => row[0]), s, t);
  const [pv] = construct(rows.map((row) => row[1]), s, t);
  return isNormal ? unitNormal(p, pu, pv) : p;
}

for await (const line of createInterface({ input: process.stdin, crlfDelay: Infinity })) {
  const [kind, id, , ...words] = line.split(" ");
  console.log(id, ...(answer(kind, words) ?? ["skip"]).map(String));
}
