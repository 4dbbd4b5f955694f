// Every kind of control flow, arrays, matrices and whole numbers; no BRDF.
//
// brdf-check: f = flow(wo, wi, int(steps))
// brdf-check: param steps = 5 in [0, 12]
const float WEIGHTS[20] = float[](
    0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5,
    0.25, 1.25, 2.25, 3.25, 4.25, 5.25, 6.25, 7.25, 8.25, 9.25);

int calls = 0;

float early(float x, int n)
{
    ++calls;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            if (i * j == 6)
                return x + float(i - j);
            if (j == i + 2)
                break;
            if ((i + j) % 3 == 1)
                continue;
            x = 0.75 * x + 0.125 * float(j);
        }
        if (x > 2.0)
            x -= 1.0;
    }
    return x;
}

float chosen(int k, inout float x)
{
    switch (k) {
        case 0: x += 0.5; return 1.0;
        case 1: x *= 2.0;
        case 2: x += 0.25; break;
        case -3: return -1.0;
        default: x = -x;
    }
    return 2.0;
}

uint scrambled(uint x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    return x * 0x846ca68bu;
}

float flow(vec3 a, vec3 b, int n)
{
    float values[4] = float[](a.x, a.y, b.x, b.y);
    float x = early(a.x, n) + values[n % 4];
    values[n % 3] = 2.0;
    x += values[0] + 10.0 * values[1] + WEIGHTS[(7 * n) % 20];
    float y = b.y;
    x += chosen(n - 3, y) * y;
    mat3 m = mat3(1.0 + a.x, 0.5, 0.25, 0.125, 2.0 + b.y, 0.5, a.y, 0.25, 3.0);
    vec3 solved = inverse(m) * b;
    x += solved.x + 2.0 * solved.y - solved.z + determinant(transpose(m));
    x += refract(normalize(-a), vec3(0, 0, 1), 0.75).x;
    x += float(scrambled(uint(n) * 2654435769u) >> 8) / 16777216.0;
    float grid[3][2];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 2; ++j)
            grid[i][j] = float(10 * i + j);
    x += grid[n % 3][n % 2];
    int k = 0;
    do { k += 3; if (k == 9) break; } while (k < n);
    while (true) { if (++k > 20 - n) break; }
    int rest = bool(n & 1) ? -n / 2 : n % 3;
    return x + float(k) + float(calls) + float(int(-2.5 * b.x)) + float(rest);
}
