/* GGX with visible normals, in C.
 *
 * brdf-check: f = ggx(wo.v, wi.v, alpha)
 * brdf-check: pdf = visible_pdf(wo.v, wi.v, alpha)
 * brdf-check: sample = (draw(wo.v, u.v, alpha, wi.v), wi)
 * brdf-check: lobe = half vector: alpha
 * brdf-check: param alpha = 0.3 in [0.01, 1]
 */
#include <math.h>

static double masked(const double *w, double a)
{
    return (sqrt(w[2] * w[2] + a * a * (w[0] * w[0] + w[1] * w[1])) / w[2] - 1.0) / 2.0;
}

static double facets(double x, double y, double z, double a)
{
    double k = (x * x + y * y) / (a * a) + z * z;
    return 1.0 / (3.14159265358979323846 * a * a * k * k);
}

double ggx(const double *wo, const double *wi, double a)
{
    double x = wo[0] + wi[0], y = wo[1] + wi[1], z = wo[2] + wi[2];
    double k = 1.0 / sqrt(x * x + y * y + z * z);
    double shadowed = 1.0 / (1.0 + masked(wo, a) + masked(wi, a));
    return facets(k * x, k * y, k * z, a) * shadowed / (4.0 * wo[2] * wi[2]);
}

double visible_pdf(const double *wo, const double *wi, double a)
{
    double x = wo[0] + wi[0], y = wo[1] + wi[1], z = wo[2] + wi[2];
    double k = 1.0 / sqrt(x * x + y * y + z * z);
    return facets(k * x, k * y, k * z, a) / (4.0 * wo[2] * (1.0 + masked(wo, a)));
}

void draw(const double *wo, const double *u, double a, double *wi)
{
    double vx = a * wo[0], vy = a * wo[1], vz = wo[2];
    double k = 1.0 / sqrt(vx * vx + vy * vy + vz * vz);
    vx *= k; vy *= k; vz *= k;
    double phi = 2.0 * 3.14159265358979323846 * u[0], z = (1.0 - u[1]) * (1.0 + vz) - vz;
    double side = sqrt(fmax(0.0, 1.0 - z * z));
    double hx = a * (side * cos(phi) + vx), hy = a * (side * sin(phi) + vy), hz = fmax(z + vz, 1e-12);
    k = 1.0 / sqrt(hx * hx + hy * hy + hz * hz);
    hx *= k; hy *= k; hz *= k;
    double twice = 2.0 * (wo[0] * hx + wo[1] * hy + wo[2] * hz);
    wi[0] = twice * hx - wo[0]; wi[1] = twice * hy - wo[1]; wi[2] = twice * hz - wo[2];
}
