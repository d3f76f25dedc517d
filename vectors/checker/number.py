"""Numbers as the files write them, and IEEE 754 rounding of exact ones.

A rational number is a Fraction, "-3/8" in the files. A floating-point number is a Fraction too, in the files
in C's hexadecimal form; where the sign of a zero matters its text is kept instead.
"""

import re
import sys
from fractions import Fraction
from functools import cache, lru_cache
from math import gcd, isqrt
from typing import NamedTuple


# Exact numbers are longer than what Python converts by default.
sys.set_int_max_str_digits(0)


class Malformed(Exception):
    """The file does not follow the format, as opposed to a wrong number."""


class Format(NamedTuple):
    """A binary format of IEEE 754: significand bits, least and greatest exponent of a normal number."""
    name: str
    precision: int
    least: int
    greatest: int

    def quantum(self, exponent):
        """Returns the exponent of the last place of numbers in [2^exponent, 2^(exponent + 1))."""
        return max(exponent, self.least) - self.precision + 1

    @cache
    def limit(self):
        """The greatest finite number."""
        return Fraction(2)**(self.greatest + 1) - Fraction(2)**(self.greatest + 1 - self.precision)

    def holds(self, x):
        """True if the finite x is a number of this format."""
        if x == 0:
            return True
        q = self.quantum(exponent(x))
        if q < 0:
            is_multiple = (1 << -q) % x.denominator == 0
        else:
            is_multiple = x.denominator == 1 and x.numerator % (1 << q) == 0
        return is_multiple and abs(x) <= self.limit()


BINARY32 = Format("binary32", 24, -126, 127)
BINARY64 = Format("binary64", 53, -1022, 1023)
LEAST_NORMAL = Fraction(1, 2**126)

_HEXADECIMAL = re.compile(r"(-?)0x1(?:\.([0-9a-f]*[1-9a-f]))?p(\+|-)(0|[1-9][0-9]*)")
_RATIONAL = re.compile(r"(0|-?[1-9][0-9]*)/([1-9][0-9]*)")
_ZEROS = ("0x0p+0", "-0x0p+0")


@cache
def power(e):
    """2^e."""
    return Fraction(1 << e) if e >= 0 else Fraction(1, 1 << -e)


def exponent(x):
    """The e with 2^e <= |x| < 2^(e + 1)."""
    n, d = abs(x.numerator), x.denominator
    e = n.bit_length() - d.bit_length()
    below = n < d << e if e >= 0 else n << -e < d
    return e - 1 if below else e


# Text

def rational_text(x):
    return f"{x.numerator}/{x.denominator}"


def read_rational(text):
    """The value of a rational number in its one permitted form."""
    match = isinstance(text, str) and _RATIONAL.fullmatch(text)
    if not match:
        raise Malformed(f"{show(text)} is not a rational number in canonical form")
    n, d = int(match[1]), int(match[2])
    if gcd(n, d) != 1:
        raise Malformed(f"{show(text)} is not in lowest terms")
    return Fraction(n, d)


def float_text(x, negative_zero=False):
    """The finite floating-point number x in hexadecimal form."""
    if x == 0:
        return _ZEROS[negative_zero]
    return _hexadecimal(abs(x.numerator), 1 - x.denominator.bit_length(), x < 0)


def _hexadecimal(n, e, is_negative):
    """Returns the text of n * 2^e, or of its opposite."""
    bits = n.bit_length() - 1
    digits = -(-bits // 4)
    fraction = f"{(n << 4 * digits - bits) - (1 << 4 * digits):0{digits}x}".rstrip("0") if digits else ""
    return f"{'-' if is_negative else ''}0x1{'.' if fraction else ''}{fraction}p{e + bits:+d}"


def read_float(text, form):
    """The value of a finite floating-point number in its one permitted form."""
    if not isinstance(text, str):
        raise Malformed(f"{show(text)} is not a finite hexadecimal number in canonical form")
    return _read_float(text, form)


@lru_cache(1 << 16)
def _read_float(text, form):
    if text in _ZEROS:
        return Fraction(0)
    match = _HEXADECIMAL.fullmatch(text)
    if not match or match[3] + match[4] == "-0":
        raise Malformed(f"{show(text)} is not a finite hexadecimal number in canonical form")
    if len(match[4]) > 5:
        raise Malformed(f"{show(text)} is not a {form.name} number")
    fraction = match[2] or ""
    x = int("1" + fraction, 16) * power(int(match[3] + match[4]) - 4 * len(fraction))
    if not form.holds(x):
        raise Malformed(f"{show(text)} is not a {form.name} number")
    return -x if match[1] else x


def show(value):
    """Returns a value for a message, shortened because exact numbers may have thousands of digits."""
    text = str(value)
    return text if len(text) <= 120 else f"{text[:60]}...{text[-40:]} ({len(text)} characters)"


# Rounding

def nearest(x, form):
    """The text of x rounded to nearest, ties to even; beyond the greatest number infinity."""
    if x == 0:
        return _ZEROS[0]
    q = form.quantum(exponent(x))
    n, rest, divisor = _divided(x, q)
    if 2 * rest > divisor or (2 * rest == divisor and n % 2 == 1):
        n += 1
    if n == 0:
        return _ZEROS[x < 0]
    if n.bit_length() + q > form.greatest + 1:
        return "-inf" if x < 0 else "inf"
    return _hexadecimal(n, q, x < 0)


def _divided(x, q):
    """Returns the quotient of |x| and 2^q, the rest, and the number that the rest is below. Integers, which are faster."""
    n, d = abs(x.numerator), x.denominator
    n, d = (n, d << q) if q >= 0 else (n << -q, d)
    return *divmod(n, d), d


def nearest_bits(x):
    """Returns the bits of x rounded to binary32. Faster than `nearest`, because it uses integers only."""
    n, d = abs(x.numerator), x.denominator
    if n == 0:
        return 0
    e = n.bit_length() - d.bit_length()
    if (n < d << e) if e >= 0 else (n << -e < d):
        e -= 1
    e = max(e, BINARY32.least)
    m, rest, below = _divided(x, e - 23)
    if 2 * rest > below or (2 * rest == below and m % 2 == 1):
        m += 1
    # The leading bit of a normal significand adds 1 to the exponent, a carry another.
    magnitude = min(((e - BINARY32.least) << 23) + m, 0x7f800000)
    return magnitude | 0x80000000 if x < 0 else magnitude


def greatest_not_above(x, form):
    """The greatest finite number of the format that is at most x; None if there is none."""
    if x < -form.limit():
        return None
    if x >= form.limit():
        return form.limit()
    if x == 0:
        return Fraction(0)
    q = power(form.quantum(exponent(x)))
    return (x / q).__floor__() * q


def least_not_below(x, form):
    below = greatest_not_above(-x, form)
    return None if below is None else -below


def nearest_root(square, sign, form):
    """The text of sign * sqrt(square), rounded like `nearest`.

    The root is truncated two bits behind the last place of the result. A sticky bit says whether the rest is zero,
    which is all that rounding to nearest needs.
    """
    if square == 0:
        return _ZEROS[0]
    places = form.precision + 2 - exponent(square) // 2
    shifted = square * power(2 * places)
    root = isqrt(shifted.numerator // shifted.denominator)
    cut = root * root != shifted
    return nearest(sign * Fraction(2 * root + cut, 2) * power(-places), form)
