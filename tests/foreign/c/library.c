/* The same as a library has it: `cc -O2 -shared -fPIC -o lib.so library.c -lm`, lib.so:brdf. */
#include "ggx.c"

const char *brdf_params = "alpha = 0.3 in [0.01, 1]";

double brdf(const double *wo, const double *wi, const double *p) { return ggx(wo, wi, p[0]); }

double brdf_pdf(const double *wo, const double *wi, const double *p)
{
    return visible_pdf(wo, wi, p[0]);
}

void brdf_sample(const double *wo, const double *u, const double *p, double *wi)
{
    draw(wo, u, p[0], wi);
}
