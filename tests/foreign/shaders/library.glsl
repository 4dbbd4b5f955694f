// The functions of GLSL's library, each with a weight of its own; no BRDF.
//
// brdf-check: f = library(wo.x, wi.x, wo.z)
float library(float x, float y, float z)
{
    vec3 v = vec3(x, y, z), w = vec3(z, x, 0.5);
    float sum = sin(x) + 2.0 * cos(y) + 3.0 * tan(0.5 * x) + 4.0 * asin(x) + 5.0 * acos(y);
    sum += atan(x) + 2.0 * atan(y, x) + 3.0 * sinh(x) + 4.0 * cosh(y) + 5.0 * tanh(z);
    sum += asinh(x) + 2.0 * acosh(1.0 + z) + 3.0 * atanh(0.5 * y) + exp(x) + 2.0 * log(z);
    sum += exp2(y) + 2.0 * log2(z) + 3.0 * sqrt(z) + 4.0 * inversesqrt(z) + pow(z, x);
    sum += pow(x, 3.0) + 2.0 * abs(x) + 3.0 * sign(y) + 4.0 * floor(5.0 * x) + 5.0 * ceil(5.0 * y);
    sum += trunc(5.0 * x) + 2.0 * round(5.0 * y) + 3.0 * fract(5.0 * x) + 4.0 * mod(5.0 * x, 0.75);
    sum += min(x, y) + 2.0 * max(x, z) + 3.0 * clamp(4.0 * x, -1.0, y) + 4.0 * mix(x, y, z);
    sum += step(x, y) + 2.0 * smoothstep(-0.5, 0.5, x) + 3.0 * fma(x, y, z) + 0.01 * degrees(x);
    sum += length(v) + 2.0 * distance(v, w) + 3.0 * dot(v, w) + cross(v, w).y + normalize(v).z;
    sum += faceforward(v, w, v).x + 2.0 * reflect(v, normalize(w)).y + radians(100.0 * x);
    sum += intBitsToFloat(floatBitsToInt(x) + 256) + float(floatBitsToUint(z) & 255u);
    sum += float(isnan(x)) + (any(lessThan(v, w)) ? 1.0 : 0.0) + (all(equal(v, v)) ? 2.0 : 0.0);
    return sum;
}
