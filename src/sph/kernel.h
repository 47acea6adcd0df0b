// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SPH_KERNEL_H
#define SPH_KERNEL_H

#include "model/model.h"

#include <math.h>
#include <stdbool.h>

/** Smoothing kernels in double precision, for walls, probes and tests; the sweeps over fluid pairs carry
 * their own copies written for the vector units. Quintic spline: paper 000 remark 5, support 3 h, exact
 * normalisation 1/120 (1-D), 7/(478 pi) (2-D), 1/(120 pi) (3-D); "published" replaces the last two by 7/(478
 * pi) and 3/(359 pi). */
struct kernel {
    int dim;
    double h;        /**< smoothing length, m */
    double support;  /**< radius r_c, m */
    double constant; /**< normalisation including 1/h^dim */
};

/** Quintic spline with smoothing length @p h. */
static inline struct kernel kernel_quintic(int dim, double h, bool published)
{
    const double pi = 3.14159265358979323846;
    double norm = dim == 1   ? 1.0 / (120.0 * h)
                  : dim == 2 ? 7.0 / (478.0 * pi * h * h)
                             : (published ? 3.0 / (359.0 * pi * h * h * h) : 1.0 / (120.0 * pi * h * h * h));
    return (struct kernel){dim, h, 3.0 * h, norm};
}

/** The kernel of the fluid of a problem. */
static inline struct kernel kernel_of_model(const struct model *model)
{
    return kernel_quintic(model->dim, model->fluid.smoothing_length_ratio * model->fluid.spacing,
                          model->fluid.kernel_constant == KERNEL_PUBLISHED);
}

/** Positive part, without the call that fmax is where NaN has to be obeyed. */
static inline double kernel_positive(double x)
{
    return x > 0.0 ? x : 0.0;
}

/** W(r), 1/m^dim. */
static inline double kernel_w(const struct kernel *kernel, double r)
{
    double q = r / kernel->h;
    double a = kernel_positive(3.0 - q), b = kernel_positive(2.0 - q), c = kernel_positive(1.0 - q);
    double a2 = a * a, b2 = b * b, c2 = c * c;
    return kernel->constant * (a2 * a2 * a - 6.0 * b2 * b2 * b + 15.0 * c2 * c2 * c);
}

/** dW/dr, 1/m^(dim+1); not positive. */
static inline double kernel_dw(const struct kernel *kernel, double r)
{
    double q = r / kernel->h;
    double a = kernel_positive(3.0 - q), b = kernel_positive(2.0 - q), c = kernel_positive(1.0 - q);
    double a2 = a * a, b2 = b * b, c2 = c * c;
    return kernel->constant / kernel->h * (-5.0 * a2 * a2 + 30.0 * b2 * b2 - 75.0 * c2 * c2);
}

#endif
