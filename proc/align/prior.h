// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/cost_function.h>

#include <vector>

namespace orbwatch::align {

/// Unknowns that are expected at `means`, each with that sigma. Equivalent to ceres::NormalPrior,
/// whose matrix takes long to compile.
class Prior final : public ceres::CostFunction {
 public:
  Prior(std::vector<double> means, double sigma);

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  std::vector<double> means_;
  double sigma_;
};

}  // namespace orbwatch::align
