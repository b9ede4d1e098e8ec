// SPDX-License-Identifier: Apache-2.0
#include "proc/align/prior.h"

#include <algorithm>
#include <utility>

namespace orbwatch::align {

Prior::Prior(std::vector<double> means, double sigma) : means_(std::move(means)), sigma_(sigma) {
  set_num_residuals(static_cast<int>(means_.size()));
  mutable_parameter_block_sizes()->push_back(static_cast<int>(means_.size()));
}

bool Prior::Evaluate(const double* const* parameters, double* residuals, double** jacobians) const {
  const std::size_t count = means_.size();
  for (std::size_t k = 0; k < count; ++k) residuals[k] = (parameters[0][k] - means_[k]) / sigma_;
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;
  std::fill_n(jacobians[0], count * count, 0.0);
  for (std::size_t k = 0; k < count; ++k) jacobians[0][k * (count + 1)] = 1 / sigma_;
  return true;
}

}  // namespace orbwatch::align
