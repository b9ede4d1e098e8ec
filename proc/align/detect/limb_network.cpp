#include "proc/align/detect/limb_network.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace orbwatch::align {
namespace {

constexpr float kWeights[]{
#include "proc/align/detect/limb_network.inc"
};

/// A convolution: how far it reaches along the limb (rays) and along the normal (columns).
struct Layer {
  int inputs, outputs;
  int rays, columns;
  int step;    ///< rays from one output to the next
  int before;  ///< rays before an output's first that it sees
};
constexpr int kFeatures = 4, kWidth = 16;
constexpr Layer kLayers[]{{kFeatures, kWidth, 8, 7, 4, 2},
                          {kWidth, kWidth, 4, 7, 2, 1},
                          {kWidth, kWidth, 3, 7, 1, 1},
                          {kWidth, 1, 3, 5, 1, 1}};

constexpr std::size_t weight_count(const Layer& layer) {
  return static_cast<std::size_t>(layer.outputs * (1 + layer.inputs * layer.rays * layer.columns));
}
static_assert(std::size(kWeights) == weight_count(kLayers[0]) + weight_count(kLayers[1]) +
                                         weight_count(kLayers[2]) + weight_count(kLayers[3]));

/// So many columns are summed at a time, in registers.
using Lanes [[gnu::vector_size(16)]] = float;
constexpr int kLanes = 4, kVectors = 3, kBlock = kLanes * kVectors;

/// Values by ray, channel and column, with zeros on both sides of the columns.
class Field {
 public:
  static constexpr int kBeside = 3;

  Field(int rays, int channels, int columns)
      : rays_(rays),
        channels_(channels),
        columns_(columns),
        stride_((columns + kBlock - 1) / kBlock * kBlock + 2 * kBeside),
        values_(static_cast<std::size_t>(rays * channels * stride_)) {}

  int rays() const { return rays_; }
  int channels() const { return channels_; }
  int columns() const { return columns_; }
  /// From the first column on.
  float* at(int ray, int channel) { return &values_[first(ray, channel)]; }
  const float* at(int ray, int channel) const { return &values_[first(ray, channel)]; }
  /// The ring is closed.
  int ring(int ray) const { return (ray + rays_) % rays_; }

 private:
  std::size_t first(int ray, int channel) const {
    return static_cast<std::size_t>((ray * channels_ + channel) * stride_ + kBeside);
  }
  int rays_, channels_, columns_, stride_;
  std::vector<float> values_;
};

/// The slopes by their likely noise, bounded; their sizes; what lies in the picture.
Field features(const LimbStrip& strip) {
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

/// `weights`: a bias for each output, then the weights by input, ray, column and output.
class Convolution {
 public:
  Convolution(const Layer& layer, std::span<const float> weights)
      : layer_(layer), biases_(weights.data()), taps_(weights.data() + layer.outputs) {}

  Field operator()(const Field& in) const {
    Field out(in.rays() / layer_.step, layer_.outputs, in.columns());
    for (int ray = 0; ray < out.rays(); ++ray) {
      for (int first = 0; first < in.columns(); first += kBlock) {
        int output = 0;
        for (; output + 1 < layer_.outputs; output += 2) fill<2>(in, ray, output, first, out);
        for (; output < layer_.outputs; ++output) fill<1>(in, ray, output, first, out);
      }
    }
    return out;
  }

 private:
  /// A block of columns of so many outputs.
  template <int outputs>
  void fill(const Field& in, int ray, int output, int first, Field& out) const {
    Lanes sums[outputs][kVectors];
    for (int o = 0; o < outputs; ++o) {
      for (Lanes& sum : sums[o]) sum = biases_[output + o] - Lanes{};
    }
    const float* weights = taps_ + output;
    for (int i = 0; i < layer_.inputs; ++i) {
      for (int r = 0; r < layer_.rays; ++r) {
        const int from = in.ring(layer_.step * ray + r - layer_.before);
        const float* column = in.at(from, i) + first - layer_.columns / 2;
        for (int t = 0; t < layer_.columns; ++t, ++column, weights += layer_.outputs) {
          for (int v = 0; v < kVectors; ++v) {
            Lanes values;
            std::memcpy(&values, column + v * kLanes, sizeof values);
            for (int o = 0; o < outputs; ++o) sums[o][v] += weights[o] * values;
          }
        }
      }
    }
    for (int o = 0; o < outputs; ++o) {
      const int count = std::min(kBlock, in.columns() - first);
      std::memcpy(out.at(ray, output + o) + first, sums[o],
                  static_cast<std::size_t>(count) * sizeof(float));
    }
  }

  Layer layer_;
  const float *biases_, *taps_;
};

void rectify(Field& field) {
  for (int ray = 0; ray < field.rays(); ++ray) {
    for (int c = 0; c < field.channels(); ++c) {
      float* const values = field.at(ray, c);
      for (int k = 0; k < field.columns(); ++k) values[k] = std::max(values[k], 0.F);
    }
  }
}

}  // namespace

LimbColumns limb_columns(const LimbStrip& strip) {
  Field field = features(strip);
  std::span<const float> weights = kWeights;
  for (const Layer& layer : kLayers) {
    const std::size_t count = weight_count(layer);
    field = Convolution(layer, weights)(field);
    weights = weights.subspan(count);
    if (!weights.empty()) rectify(field);
  }
  LimbColumns limb{field.rays(), field.columns(), {}};
  limb.probabilities.reserve(static_cast<std::size_t>(limb.parts * limb.columns));
  for (int part = 0; part < limb.parts; ++part) {
    const float* const values = field.at(part, 0);
    const float most = std::max(0.F, *std::max_element(values, values + limb.columns));
    float total = std::exp(-most);  // none
    for (int k = 0; k < limb.columns; ++k) total += std::exp(values[k] - most);
    for (int k = 0; k < limb.columns; ++k) {
      limb.probabilities.push_back(std::exp(values[k] - most) / total);
    }
  }
  return limb;
}

}  // namespace orbwatch::align
