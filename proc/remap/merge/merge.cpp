#include "proc/remap/merge/merge.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace orbwatch::remap {
namespace {

constexpr int kReciprocalBits = 40;
constexpr std::uint32_t kLargestTotal = kMaxSources * UINT8_MAX;

// floor(n / total) = n * kReciprocals[total] >> kReciprocalBits, exactly: the reciprocal is too
// large by less than 1, so the product errs by less than n / 2^40, and n < 2^26 stays below what
// separates two multiples of 1 / total > 2^-10. No weight at all gives 0.
constexpr auto kReciprocals = [] {
  std::array<std::uint64_t, kLargestTotal + 1> reciprocals{};
  for (std::uint32_t total = 1; total <= kLargestTotal; ++total) {
    reciprocals[total] = (std::uint64_t{1} << kReciprocalBits) / total + 1;
  }
  return reciprocals;
}();

/// One row of every source.
template <class T>
struct SourceRows {
  SourceRows(std::span<const MergeSource<T>> sources, int y) : count(sources.size()) {
    for (std::size_t n = 0; n < count; ++n) {
      picture[n] = sources[n].picture.row(y);
      weights[n] = sources[n].weights.row(y);
    }
  }
  std::size_t count;
  std::array<const T*, kMaxSources> picture{};
  std::array<const std::uint8_t*, kMaxSources> weights{};
};

/// One pixel as the mean by weight; false where no source sees it.
struct Mean {
  template <int Channels, class T>
  static bool pixel(const SourceRows<T>& in, int x, T* out) {
    std::array<std::uint32_t, Channels> sum{};
    std::uint32_t total = 0;
    for (std::size_t n = 0; n < in.count; ++n) {
      const std::uint32_t weight = in.weights[n][x];
      total += weight;
      for (int k = 0; k < Channels; ++k) sum[k] += weight * in.picture[n][Channels * x + k];
    }
    const std::uint64_t reciprocal = kReciprocals[total];
    for (int k = 0; k < Channels; ++k) {
      out[k] = static_cast<T>((sum[k] + total / 2) * reciprocal >> kReciprocalBits);
    }
    return total > 0;
  }
};

/// One pixel of the first source that sees it; false where none does.
struct First {
  template <int Channels, class T>
  static bool pixel(const SourceRows<T>& in, int x, T* out) {
    for (std::size_t n = 0; n < in.count; ++n) {
      if (in.weights[n][x] == 0) continue;
      for (int k = 0; k < Channels; ++k) out[k] = in.picture[n][Channels * x + k];
      return true;
    }
    std::fill_n(out, Channels, T{0});
    return false;
  }
};

template <class Rule, int Channels, class T>
void merge_rows(std::span<const MergeSource<T>> sources, const ImageView<T>& out,
                const ImageView<std::uint8_t>& validity, TileRows rows) {
  const int last = std::min(rows.last * kTile, out.height);
  for (int y = rows.first * kTile; y < last; ++y) {
    const SourceRows<T> in(sources, y);
    T* pixel = out.row(y);
    std::uint8_t* valid = validity.row(y);
    for (int x = 0; x < out.width; ++x, pixel += Channels) {
      if (Rule::template pixel<Channels>(in, x, pixel)) {
        valid[x] = static_cast<std::uint8_t>(Validity::Seen);
      }
    }
  }
}

template <class Rule, class T>
void merge_by(std::span<const MergeSource<T>> sources, const ImageView<T>& out,
              const ImageView<std::uint8_t>& validity, TileRows rows) {
  assert(sources.size() <= kMaxSources);
  assert(out.channels == 1 || out.channels == 3);
  out.channels == 1 ? merge_rows<Rule, 1>(sources, out, validity, rows)
                    : merge_rows<Rule, 3>(sources, out, validity, rows);
}

}  // namespace

template <class T>
void merge(MergeRule rule, std::span<const MergeSource<T>> sources, const ImageView<T>& out,
           const ImageView<std::uint8_t>& validity, TileRows rows) {
  rule == MergeRule::First ? merge_by<First>(sources, out, validity, rows)
                           : merge_by<Mean>(sources, out, validity, rows);
}

template void merge(MergeRule, std::span<const MergeSource<std::uint8_t>>,
                    const ImageView<std::uint8_t>&, const ImageView<std::uint8_t>&, TileRows);
template void merge(MergeRule, std::span<const MergeSource<std::uint16_t>>,
                    const ImageView<std::uint16_t>&, const ImageView<std::uint8_t>&, TileRows);

}  // namespace orbwatch::remap
