"""Fixed-width integer words that mean the same in plain Python and in compiled kernels.

Plain Python integers have no width and numba's have no masks, so code on words is written with
`u64`, `u32`, `reverse32`, `word_of`, `double_of`, `number_of`: ordinary functions here, machine
instructions in a kernel (compile.twins). So is `smaller`, of numbers.
"""

from __future__ import annotations

import ctypes
import struct

GOLDEN = 0x9E3779B97F4A7C15  # 2^64 / golden ratio, odd: steps that never repeat within 2^64
LOW = 0xFFFFFFFF  # the lower half of a word
ROUNDER = 6755399441055744.0  # 1.5 * 2^52: adding it rounds to an integer in the low bits
ROUNDER_WORD = 0x4338000000000000


def u64(x: int) -> int:
    """x modulo 2^64."""
    return int(x) & 0xFFFFFFFFFFFFFFFF


def u32(x: int) -> int:
    """x modulo 2^32."""
    return int(x) & 0xFFFFFFFF


def reverse32(x: int) -> int:
    """The 32 bits of x in reverse order."""
    return int(f"{x:032b}"[::-1], 2)


def word_of(x: float) -> int:
    """The 64 bits of a double as a signed integer; ordered like the doubles where x >= 0."""
    return int(struct.unpack("<q", struct.pack("<d", x))[0])


def double_of(word: int) -> float:
    """The double whose bits are `word` modulo 2^64: the inverse of `word_of`."""
    return float(struct.unpack("<d", struct.pack("<Q", u64(word)))[0])


def number_of(word: int) -> float:
    """A whole number of less than 2^51 as a double: cheaper than a conversion of all 64 bits."""
    return float(word)


def double_at(address: float, index: int) -> float:
    """The double `index` places after a memory address, which is whole and below 2^53.

    Raises TypeError for an address in any other arithmetic, which would lead elsewhere.
    """
    if not isinstance(address, float):
        raise TypeError("a table in memory is found by an address, which only a double holds")
    return float(ctypes.c_double.from_address(int(address) + 8 * index).value)


def smaller(a: float, b: float) -> float:
    """The smaller of two numbers; a kernel takes it that neither is NaN.

    So that a running minimum is one instruction: a comparison that heeds NaN does not vectorise.
    """
    return a if a < b else b


def mix64(z: int) -> int:
    """A bijection of 64-bit words in which every input bit moves every output bit.

    Source: Stafford's variant 13 of the MurmurHash3 finaliser, as in SplitMix64
    (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators").
    """
    z = u64((z ^ (z >> u64(30))) * u64(0xBF58476D1CE4E5B9))
    z = u64((z ^ (z >> u64(27))) * u64(0x94D049BB133111EB))
    return z ^ (z >> u64(31))


def unit(z: int) -> float:
    """A 64-bit word as a number in [0, 1 - 2^-52], from its upper 52 bits.

    They become the fraction of a number in [1, 2): cheaper in vectors than converting an integer.
    """
    return double_of((z >> u64(12)) | u64(0x3FF0000000000000)) - 1.0
