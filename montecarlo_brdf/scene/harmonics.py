"""Real spherical harmonics to band 4 as polynomials of (x, y, z).

Order l^2 + l + m; orthonormal over the sphere, without the Condon-Shortley phase.
Source: Ramamoorthi & Hanrahan 2001, "An efficient representation for irradiance environment maps",
eq. 3; Sloan 2008, "Stupid spherical harmonics tricks", appendix A2.
"""

from __future__ import annotations

import math
from typing import Any

PI = math.pi
K1 = math.sqrt(3.0 / (4.0 * PI))
K2 = 0.5 * math.sqrt(15.0 / PI)
K3A, K3B, K3C = math.sqrt(35.0 / (2.0 * PI)), math.sqrt(105.0 / PI), math.sqrt(21.0 / (2.0 * PI))
K4A, K4B = math.sqrt(35.0 / PI), math.sqrt(5.0 / (2.0 * PI))


def harmonics(w: Any, c: Any) -> float:
    """Sum of c_lm Y_lm(w) over 25 coefficients."""
    x, y, z = w[0], w[1], w[2]
    xx, yy, zz = x * x, y * y, z * z
    low = 0.5 / math.sqrt(PI) * c[0] + K1 * (c[1] * y + c[2] * z + c[3] * x)
    two = c[4] * x * y + c[5] * y * z + c[7] * x * z + 0.5 * c[8] * (xx - yy)
    two = K2 * (two + c[6] * math.sqrt(1.0 / 48.0) * (3.0 * zz - 1.0) * 2.0)
    three = 0.25 * K3A * (c[9] * y * (3.0 * xx - yy) + c[15] * x * (xx - 3.0 * yy))
    three += K3B * (0.5 * c[10] * x * y * z + 0.25 * c[14] * z * (xx - yy))
    three += 0.25 * K3C * (5.0 * zz - 1.0) * (c[11] * y + c[13] * x)
    three += 0.25 * math.sqrt(7.0 / PI) * c[12] * z * (5.0 * zz - 3.0)
    four = 0.75 * K4A * c[16] * x * y * (xx - yy)
    four += 0.75 * K3A * z * (c[17] * y * (3.0 * xx - yy) + c[23] * x * (xx - 3.0 * yy))
    four += 0.75 * K4B * (7.0 * zz - 3.0) * z * (c[19] * y + c[21] * x)
    five = 0.75 * c[18] * x * y + 0.375 * c[22] * (xx - yy)
    four += math.sqrt(5.0 / PI) * (7.0 * zz - 1.0) * five
    four += 0.1875 / math.sqrt(PI) * c[20] * ((35.0 * zz - 30.0) * zz + 3.0)
    four += 0.1875 * K4A * c[24] * (xx * (xx - 3.0 * yy) - yy * (3.0 * xx - yy))
    return low + two + three + four
