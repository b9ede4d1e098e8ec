// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace orbwatch::align {

/// Values by ray, channel and column, with zeros on both sides of the columns. Rays form a ring.
class Field {
 public:
  Field(int rays, int channels, int columns);

  int rays() const { return rays_; }
  int channels() const { return channels_; }
  int columns() const { return columns_; }
  /// The values of a ray and channel, from the first column on.
  float* at(int ray, int channel) { return &values_[first(ray, channel)]; }
  const float* at(int ray, int channel) const { return &values_[first(ray, channel)]; }
  /// Wraps a ray index around the ring.
  int ring(int ray) const { return (ray + rays_) % rays_; }

 private:
  std::size_t first(int ray, int channel) const;

  int rays_, channels_, columns_, stride_;
  std::vector<float> values_;
};

/// A convolution with its reach along the ring (rays) and outwards (columns).
struct Layer {
  int inputs, outputs;
  int rays, columns;
  int step;    ///< rays from one output to the next
  int before;  ///< input rays before an output's first one
};

constexpr std::size_t weight_count(const Layer& layer) {
  return static_cast<std::size_t>(layer.outputs * (1 + layer.inputs * layer.rays * layer.columns));
}

/// True on processors that compute eight columns at a time.
bool has_vectors_of_eight();

/// `weights`: a bias for each output, then the weights by input, ray, column and output.
/// `by_eight`: computes eight columns at a time, with the same result. Reentrant.
Field convolution(const Field& in, const Layer& layer, std::span<const float> weights,
                  bool by_eight = has_vectors_of_eight());

/// Sets values below 0 to 0.
void rectify(Field& field);

}  // namespace orbwatch::align
