// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/limb/limb_network.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "proc/align/detect/picture/convolution.h"

namespace orbwatch::align {
namespace {

constexpr float kLimbWeights[]{
#include "proc/align/detect/limb/limb_network.inc"
};
constexpr float kRingWeights[]{
#include "proc/align/detect/ring/ring_network.inc"
};

constexpr int kFeatures = 4;

/// The networks' layers; they differ only in their number of channels.
template <int width>
constexpr Layer kLayers[]{{kFeatures, width, 8, 7, 4, 2},
                          {width, width, 4, 7, 2, 1},
                          {width, width, 3, 7, 1, 1},
                          {width, 1, 3, 5, 1, 1}};
constexpr std::span<const Layer> kLimbLayers = kLayers<16>, kRingLayers = kLayers<8>;

constexpr std::size_t weight_count(std::span<const Layer> layers) {
  std::size_t count = 0;
  for (const Layer& layer : layers) count += weight_count(layer);
  return count;
}
static_assert(std::size(kLimbWeights) == weight_count(kLimbLayers));
static_assert(std::size(kRingWeights) == weight_count(kRingLayers));

/// Inputs of the network: slopes divided by their likely noise, bounded; their magnitudes; a mask
/// of the picture.
Field features(const SlopeStrip& strip) {
  Field field(strip.rays(), kFeatures, strip.columns());
  const float scale = 0.5F / std::sqrt(strip.floor2());
  for (int ray = 0; ray < field.rays(); ++ray) {
    for (int k = 0; k < field.columns(); ++k) {
      const auto slope = strip.slope(ray, k);
      if (!slope) continue;
      const float along = scale * slope->along, across = scale * slope->across;
      field.at(ray, 0)[k] = along / std::sqrt(1 + along * along);
      field.at(ray, 1)[k] = across / std::sqrt(1 + across * across);
      field.at(ray, 2)[k] = std::copysign(std::log1p(std::abs(along)) / 3, along);
      field.at(ray, 3)[k] = 1;
    }
  }
  return field;
}

LimbColumns columns_of(const SlopeStrip& strip, std::span<const Layer> layers,
                       std::span<const float> weights) {
  Field field = features(strip);
  for (const Layer& layer : layers) {
    field = convolution(field, layer, weights);
    weights = weights.subspan(weight_count(layer));
    if (!weights.empty()) rectify(field);
  }
  LimbColumns limb{field.rays(), field.columns(), {}};
  limb.probabilities.reserve(static_cast<std::size_t>(limb.parts * limb.columns));
  for (int part = 0; part < limb.parts; ++part) {
    const float* const values = field.at(part, 0);
    const float most = std::max(0.F, *std::max_element(values, values + limb.columns));
    float total = std::exp(-most);  // weight of no limb
    for (int k = 0; k < limb.columns; ++k) total += std::exp(values[k] - most);
    for (int k = 0; k < limb.columns; ++k) {
      limb.probabilities.push_back(std::exp(values[k] - most) / total);
    }
  }
  return limb;
}

}  // namespace

double LimbColumns::angle(int n) const {
  const double middle = kRays * (n + 0.5) - 0.5;
  return 2 * std::numbers::pi * middle / (kRays * parts);
}

std::vector<float> LimbColumns::above_random() const {
  constexpr float kStray = 0.05F;  // share of parts without information
  const float scale = (1 - kStray) * static_cast<float>(columns);
  std::vector<float> nats;
  nats.reserve(probabilities.size());
  for (const float p : probabilities) nats.push_back(std::log(kStray + scale * p));
  return nats;
}

LimbColumns limb_columns(const LimbStrip& strip) {
  return columns_of(strip, kLimbLayers, kLimbWeights);
}

LimbColumns limb_columns(const RingStrip& strip) {
  return columns_of(strip, kRingLayers, kRingWeights);
}

}  // namespace orbwatch::align
