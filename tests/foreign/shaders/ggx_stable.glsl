// GGX in a form that keeps its digits: 1 - h.n^2 is |n x h|^2, and nothing cancels.
//
// brdf-check: f = ggx(wo, wi, alpha)
// brdf-check: param alpha = 0.3 in [0.001, 1]
const float PI = 3.14159265358979;

float stretched(vec3 w, float a)
{
    return sqrt(w.z * w.z + a * a * dot(w.xy, w.xy));
}

float ggx(vec3 wo, vec3 wi, float a)
{
    vec3 h = normalize(wo + wi);
    vec3 side = cross(vec3(0, 0, 1), h);
    float d = a / (dot(side, side) + a * a * h.z * h.z);
    return d * d * 0.5 / (PI * (wi.z * stretched(wo, a) + wo.z * stretched(wi, a)));
}
