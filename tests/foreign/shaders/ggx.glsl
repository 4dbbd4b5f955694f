// GGX with height-correlated masking, as a fragment shader would have it.
//
// brdf-check: f = ggx(wo, wi, alpha)
// brdf-check: pdf = visible_pdf(wo, wi, alpha)
// brdf-check: sample = draw(wo, u.xy, alpha)
// brdf-check: param alpha = 0.3 in [0.01, 1]
#version 330
precision highp float;

const float PI = 3.14159265358979;

float distribution(float h, float a)
{
    float d = h * h * (a * a - 1.0) + 1.0;
    return a * a / (PI * d * d);
}

float stretched(float mu, float a)
{
    return sqrt(mu * mu * (1.0 - a * a) + a * a);
}

float ggx(vec3 wo, vec3 wi, float a)
{
    vec3 h = normalize(wo + wi);
    float masked = wi.z * stretched(wo.z, a) + wo.z * stretched(wi.z, a);
    return 2.0 * distribution(h.z, a) / (4.0 * masked);
}

float visible_pdf(vec3 wo, vec3 wi, float a)
{
    vec3 h = normalize(wo + wi);
    return 0.5 * distribution(h.z, a) / (wo.z + stretched(wo.z, a));
}

vec3 draw(vec3 wo, vec2 u, float a)
{
    vec3 v = normalize(vec3(a * wo.xy, wo.z));
    float phi = 2.0 * PI * u.x;
    float z = (1.0 - u.y) * (1.0 + v.z) - v.z;
    float s = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    vec3 h = vec3(s * cos(phi), s * sin(phi), z) + v;
    h = normalize(vec3(a * h.xy, max(h.z, 0.0)));
    return reflect(-wo, h);
}
