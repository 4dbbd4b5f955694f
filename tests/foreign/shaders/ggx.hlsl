// GGX with its width in a constant buffer.
//
// brdf-check: f = ggx(wo, wi)
// brdf-check: pdf = visible_pdf(wo, wi)
// brdf-check: sample = draw(wo, u.xy)
// brdf-check: param alpha = 0.3 in [0.01, 1]
cbuffer Material : register(b0)
{
    float alpha;
    float4 unused;
};
static const float PI = 3.14159265358979;

float distribution(float h)
{
    float d = h * h * (alpha * alpha - 1.0) + 1.0;
    return alpha * alpha / (PI * d * d);
}

float stretched(float mu)
{
    return sqrt(mu * mu * (1.0 - alpha * alpha) + alpha * alpha);
}

float ggx(float3 wo, float3 wi)
{
    float3 h = normalize(wo + wi);
    return distribution(h.z) * 0.5 / (wi.z * stretched(wo.z) + wo.z * stretched(wi.z));
}

float visible_pdf(float3 wo, float3 wi)
{
    float3 h = normalize(wo + wi);
    return 0.5 * distribution(h.z) / (wo.z + stretched(wo.z));
}

float3 draw(float3 wo, float2 u)
{
    float3 v = normalize(float3(alpha * wo.xy, wo.z));
    float phi = 2.0 * PI * u.x;
    float z = (1.0 - u.y) * (1.0 + v.z) - v.z;
    float s = sqrt(saturate(1.0 - z * z));
    float3 h = float3(s * cos(phi), s * sin(phi), z) + v;
    h = normalize(float3(alpha * h.xy, max(h.z, 0.0)));
    return reflect(-wo, h);
}
