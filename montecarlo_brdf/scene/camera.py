"""An orthographic view of the unit sphere: which pixels show it, with which frame."""

from __future__ import annotations

from typing import Any

from montecarlo_brdf.vectors import Vec


def disk_of(size: int) -> tuple[Any, Any]:
    """Which pixels show the sphere, and (right, up, towards the camera) of its normals there."""
    import numpy as np

    x = (np.arange(size) + 0.5) * (2.2 / size) - 1.1
    x, y = np.meshgrid(x, -x)
    inside = x * x + y * y < 1.0
    x, y = x[inside], y[inside]
    return inside, (x, y, np.sqrt(1.0 - x * x - y * y))


def in_world(disk: Any, camera: Vec) -> Any:
    """Normals of the disk's pixels in the world."""
    import numpy as np

    x, y, z = disk
    right, up = _screen(camera)
    return x[:, None] * right + y[:, None] * up + z[:, None] * np.array(camera)


def _screen(camera: Vec) -> tuple[Any, Any]:
    """Right and up of the picture: up is the world's z, or y when looking along z."""
    import numpy as np

    pole = (0.0, 1.0, 0.0) if abs(camera[2]) > 0.999999 else (0.0, 0.0, 1.0)
    right = np.cross(pole, camera)
    right /= np.linalg.norm(right)
    return right, np.cross(camera, right)


def places_of(normals: Any, camera: Vec, mu: Any, isotropic: bool) -> Any:
    """View in the frame, tangent, bitangent, normal; anisotropic tangents run along latitudes."""
    import numpy as np

    view = np.array(camera)
    along = view - mu[:, None] * normals if isotropic else np.cross((0.0, 0.0, 1.0), normals)
    length = np.linalg.norm(along, axis=1, keepdims=True)
    spare = np.cross(normals, (0.0, 1.0, 0.0)) + 1e-12
    along = np.where(length > 1e-9, along / np.maximum(length, 1e-9), spare)
    tangent = along - np.sum(along * normals, axis=1, keepdims=True) * normals
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    bitangent = np.cross(normals, tangent)
    local = np.stack([tangent @ view, bitangent @ view, mu], axis=1)
    return np.concatenate([local, tangent, bitangent, normals], axis=1)


def towards(light: Any, normals: Any) -> tuple[Any, Any]:
    """Unit vectors from every point to the light, and the factors on its colour."""
    import numpy as np

    if not hasattr(light, "position"):
        return np.tile(np.array(light.direction), (len(normals), 1)), np.ones(len(normals))
    to = np.array(light.position) - normals
    d = np.linalg.norm(to, axis=1)
    a, b, c = light.falloff
    return to / d[:, None], 1.0 / (a + b * d + c * d * d)
