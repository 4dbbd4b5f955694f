// A coloured diffuse layer below a grey reflection, with the cosine in f, as engines write it.
//
// brdf-check: before = Surface surface; surface.base = base; surface.rough = rough;
// brdf-check: before = surface.layered = layered; surface.steps = steps;
// brdf-check: f = shade(surface, wi, wo)
// brdf-check: pdf = max(wi.z, 0.0) / 3.14159265358979
// brdf-check: sample = towards(u)
// brdf-check: cosine = included
// brdf-check: param base = color(0.9, 0.5, 0.1) in [0, 1]
// brdf-check: param rough = 0.5 in [0.1, 1]
// brdf-check: param layered = true
// brdf-check: param steps = 3 in [0, 8]
uniform int steps;

struct Surface
{
    vec3 base;
    float rough;
    bool layered;
    int steps;
};

vec3 shade(Surface s, vec3 light, vec3 view)
{
    vec3 result = s.base / 3.14159265358979;
    float fresnel = pow(1.0 - max(dot(normalize(light + view), view), 0.0), 5.0);
    for (int k = 0; k < s.steps; ++k)
        result *= 0.95;
    if (s.layered)
        result = mix(result, vec3(0.05), fresnel * (1.0 - s.rough));
    return result * light.z;
}

vec3 towards(vec3 u)
{
    float r = sqrt(u.x);
    float phi = radians(360.0) * u.y;
    return vec3(r * cos(phi), r * sin(phi), sqrt(max(1.0 - u.x, 0.0)));
}
