// Paint: a coat over metal or a coloured base, as engines have it, in a hundred lines.
//
// brdf-check: before = Paint paint = painted(base, metalness, roughness, stretch, coat, twoSided);
// brdf-check: f = evaluate(paint, wo, wi)
// brdf-check: pdf = density(paint, wo, wi)
// brdf-check: sample = draw(paint, wo, u)
// brdf-check: isotropic = false
// brdf-check: lobe = half vector: roughness^2
// brdf-check: param base = color(0.8, 0.5, 0.2) in [0, 1]
// brdf-check: param metalness = 0.5 in [0, 1]
// brdf-check: param roughness = 0.6 in [0.3, 1]
// brdf-check: param stretch = 0.3 in [0, 0.9]
// brdf-check: param coat = 0.5 in [0, 1]
// brdf-check: param twoSided = false
#version 430
precision highp float;
#define PI 3.14159265358979
#define saturate(x) clamp(x, 0.0, 1.0)

struct Lobe
{
    vec2 alpha;
    vec3 f0;
};

struct Paint
{
    vec3 diffuse;
    Lobe metal;
    Lobe coat;
    float share; // of the draws, for the coat
    float amount; // of the coat
    bool twoSided;
};

float square(float x) { return x * x; }
vec3 schlick(vec3 f0, float c) { return f0 + (1.0 - f0) * pow(saturate(1.0 - c), 5.0); }

Paint painted(vec3 base, float metalness, float roughness, float stretch, float coat, bool twoSided)
{
    Paint paint;
    float aspect = sqrt(1.0 - 0.9 * stretch), alpha = square(roughness);
    paint.diffuse = base * (1.0 - metalness);
    paint.metal.alpha = max(vec2(alpha / aspect, alpha * aspect), 1e-3);
    paint.metal.f0 = mix(vec3(0.04), base, metalness);
    paint.coat = Lobe(vec2(0.2), vec3(0.04));
    paint.amount = coat;
    paint.share = 0.25 * coat;
    paint.twoSided = twoSided;
    return paint;
}

// How many microfacets have the normal h, per solid angle
float facets(Lobe lobe, vec3 h)
{
    float k = square(h.x / lobe.alpha.x) + square(h.y / lobe.alpha.y) + square(h.z);
    return 1.0 / (PI * lobe.alpha.x * lobe.alpha.y * k * k);
}

float masked(Lobe lobe, vec3 w)
{
    vec2 s = lobe.alpha * w.xy;
    return 0.5 * (sqrt(1.0 + dot(s, s) / square(w.z)) - 1.0);
}

vec3 reflected(Lobe lobe, vec3 wo, vec3 wi, vec3 h)
{
    float shadowed = 1.0 / (1.0 + masked(lobe, wo) + masked(lobe, wi));
    return schlick(lobe.f0, dot(wo, h)) * facets(lobe, h) * shadowed / (4.0 * wo.z * wi.z);
}

vec3 evaluate(Paint paint, vec3 wo, vec3 wi)
{
    if (wo.z <= 0.0 || wi.z <= 0.0)
        return vec3(0.0);
    vec3 h = normalize(wo + wi);
    if (paint.twoSided && h.z < 0.0)
        h = -h;
    vec3 under = paint.diffuse / PI * (1.0 - schlick(paint.metal.f0, wo.z));
    under = under * (1.0 - schlick(paint.metal.f0, wi.z)) + reflected(paint.metal, wo, wi, h);
    float through = 1.0 - paint.amount * schlick(paint.coat.f0, wo.z).x;
    through *= 1.0 - paint.amount * schlick(paint.coat.f0, wi.z).x;
    return under * through + paint.amount * reflected(paint.coat, wo, wi, h);
}

float density_of(Lobe lobe, vec3 wo, vec3 h)
{
    return facets(lobe, h) / (4.0 * wo.z * (1.0 + masked(lobe, wo)));
}

float density(Paint paint, vec3 wo, vec3 wi)
{
    vec3 h = normalize(wo + wi);
    float both[2] = float[2](density_of(paint.metal, wo, h), density_of(paint.coat, wo, h));
    return 0.5 * wi.z / PI + (0.5 - paint.share) * both[0] + paint.share * both[1];
}

vec3 facet(Lobe lobe, vec3 wo, vec2 u)
{
    vec3 v = normalize(vec3(lobe.alpha * wo.xy, wo.z));
    float phi = 2.0 * PI * u.x, z = (1.0 - u.y) * (1.0 + v.z) - v.z;
    float side = sqrt(saturate(1.0 - z * z));
    vec3 h = vec3(side * cos(phi), side * sin(phi), z) + v;
    return normalize(vec3(lobe.alpha * h.xy, max(h.z, 1e-7)));
}

vec3 draw(Paint paint, vec3 wo, vec3 u)
{
    if (u.z < 0.5)
    {
        float r = sqrt(u.x), phi = 2.0 * PI * u.y;
        return vec3(r * cos(phi), r * sin(phi), sqrt(max(0.0, 1.0 - u.x)));
    }
    Lobe lobe = paint.metal;
    if (u.z < 0.5 + paint.share)
        lobe = paint.coat;
    return reflect(-wo, facet(lobe, wo, u.xy));
}
