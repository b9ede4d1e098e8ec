#include "proc/remap/merge/merge.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <type_traits>

#include "proc/remap/colour/run_vector.h"

namespace orbwatch::remap {
namespace {

constexpr int kRun = kRunPixels;

template <class T, int Channels>
using Samples = std::array<T, kRun * Channels>;

/// The largest dividend: 4 sources of weight 255 with the largest samples, and half of the divisor.
template <class T>
constexpr std::uint32_t kLargestSum =
    kMaxSources* UINT8_MAX* std::uint32_t{std::numeric_limits<T>::max()} + kMaxSources * 128;

/// floor(sum / total), exactly. The computed quotient errs by less than 2^-15. One that is no whole
/// number lies at least 1 / total > 2^-10 below the next, so that the margin lifts over a whole
/// number only what an error left below it.
template <class T>
T quotient(std::uint32_t sum, std::uint32_t total) {
  using Real = std::conditional_t<sizeof(T) == 1, float, double>;
  static_assert(kLargestSum<T> < (sizeof(T) == 1 ? 1U << 24 : 1U << 31));
  constexpr Real kMargin = Real{1} / 4096;
  // Signed integers are what vector units convert.
  const Real reciprocal = Real{1} / static_cast<Real>(static_cast<std::int32_t>(total));
  return static_cast<T>(static_cast<std::int32_t>(
      static_cast<Real>(static_cast<std::int32_t>(sum)) * reciprocal + kMargin));
}

/// The weights of a run's pixels for each of their samples.
template <int Channels>
[[gnu::always_inline]] inline void spread(const std::uint8_t* weights,
                                          Samples<std::uint8_t, Channels>& samples) {
  for (int x = 0; x < kRun; ++x) {
    for (int k = 0; k < Channels; ++k) samples[Channels * x + k] = weights[x];
  }
}

/// One run of every source.
template <class T, std::size_t Count>
struct SourceRuns {
  static constexpr std::size_t count = Count;
  std::array<const T*, Count> picture{};
  std::array<const std::uint8_t*, Count> weights{};
};

template <class Runs>
[[gnu::always_inline]] inline Words totals_of(const Runs& in) {
  Words totals{};
  for (std::size_t n = 0; n < in.count; ++n) totals += widened(load<Bytes>(in.weights[n]));
  return totals;
}

/// Whether all weights of a run add up to 255 or 256, as rounded ones do where all see.
[[gnu::always_inline]] inline bool is_full(const Words& totals) {
  return is_zero((totals - 255) & 0xfffe);
}

/// The weights of the samples of a run, of which this is part `part`.
template <int Channels>
[[gnu::always_inline]] inline Bytes weights_of_part(const Bytes& weights, int part) {
  if constexpr (Channels == 1) {
    return weights;
  } else {
    switch (part) {
      case 0:
        return __builtin_shufflevector(weights, weights, 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4,
                                       4, 5);
      case 1:
        return __builtin_shufflevector(weights, weights, 5, 5, 6, 6, 6, 7, 7, 7, 8, 8, 8, 9, 9, 9,
                                       10, 10);
      default:
        return __builtin_shufflevector(weights, weights, 10, 11, 11, 11, 12, 12, 12, 13, 13, 13, 14,
                                       14, 14, 15, 15, 15);
    }
  }
}

/// The mean of a run of 8 bit samples whose weights are full: its sums fit 16 bits, and dividing by
/// 255 takes shifts.
template <int Channels, class Runs>
[[gnu::always_inline]] inline void full_mean(const Runs& in, std::uint8_t* out) {
  std::array<Words, Channels> sums{};
  std::array<Bytes, Channels> totals{};
  for (std::size_t n = 0; n < in.count; ++n) {
    const Bytes weights = load<Bytes>(in.weights[n]);
    for (int part = 0; part < Channels; ++part) {
      const Bytes share = weights_of_part<Channels>(weights, part);
      sums[part] += widened(share) * widened(load<Bytes>(in.picture[n] + kRun * part));
      totals[part] += share;
    }
  }
  for (int part = 0; part < Channels; ++part) {
    const Words rounded = sums[part] + 128;
    const Bytes by_256 = narrowed(rounded >> 8);
    const Bytes by_255 = narrowed((rounded + (rounded >> 8)) >> 8);
    store(totals[part] == 0 ? by_256 : by_255, out + kRun * part);
  }
}

/// One run as the mean by weight, for any weights: no weight at all gives 0.
template <int Channels, class Runs, class T>
[[gnu::noinline]] void any_mean(const Runs& in, const Words& totals, T* out) {
  Samples<std::uint32_t, Channels> sums;
  for (int x = 0; x < kRun; ++x) {
    for (int k = 0; k < Channels; ++k) sums[Channels * x + k] = totals[x] / 2U;
  }
  Samples<std::uint8_t, Channels> weights;
  for (std::size_t n = 0; n < in.count; ++n) {
    spread<Channels>(in.weights[n], weights);
    const T* const picture = in.picture[n];
    for (int i = 0; i < kRun * Channels; ++i) {
      sums[i] += std::uint32_t{weights[i]} * picture[i];
    }
  }
  for (int x = 0; x < kRun; ++x) {
    const std::uint32_t total = std::max<std::uint32_t>(1, totals[x]);
    for (int k = 0; k < Channels; ++k) {
      out[Channels * x + k] = quotient<T>(sums[Channels * x + k], total);
    }
  }
}

/// One run as the mean by weight; `seen` becomes the pixels that some source sees.
struct Mean {
  template <int Channels, class Runs, class T>
  [[gnu::always_inline]] static void run(const Runs& in, T* out, Bytes& seen) {
    const Words totals = totals_of(in);
    seen = narrowed(totals | totals >> 8);
    if constexpr (sizeof(T) == 1) {
      if (is_full(totals)) return full_mean<Channels>(in, out);
    }
    any_mean<Channels>(in, totals, out);
  }
};

/// One run of the first source that sees each pixel.
struct First {
  template <int Channels, class Runs, class T>
  [[gnu::always_inline]] static void run(const Runs& in, T* out, Bytes& seen) {
    const Words totals = totals_of(in);
    seen = narrowed(totals | totals >> 8);
    Samples<T, Channels> chosen{};
    Samples<std::uint8_t, Channels> weights;
    for (std::size_t n = in.count; n-- > 0;) {
      spread<Channels>(in.weights[n], weights);
      const T* const picture = in.picture[n];
      for (int i = 0; i < kRun * Channels; ++i) {
        chosen[i] = weights[i] != 0 ? picture[i] : chosen[i];
      }
    }
    std::copy_n(chosen.begin(), kRun * Channels, out);
  }
};

/// A run that the border cuts, with memory of its own.
template <class T, int Channels, std::size_t Count>
struct CutRun {
  CutRun(const SourceRuns<T, Count>& in, int columns) {
    for (std::size_t n = 0; n < Count; ++n) {
      std::copy_n(in.picture[n], columns * Channels, pictures[n].begin());
      std::copy_n(in.weights[n], columns, weights[n].begin());
      runs.picture[n] = pictures[n].data();
      runs.weights[n] = weights[n].data();
    }
  }

  SourceRuns<T, Count> runs;
  std::array<Samples<T, Channels>, Count> pictures{};
  std::array<Samples<std::uint8_t, 1>, Count> weights{};
};

constexpr auto kSeen = static_cast<std::uint8_t>(Validity::Seen);

/// What lies below each other at one place of all pictures.
template <class T, int Channels, std::size_t Count>
class Column {
 public:
  Column(std::span<const MergeSource<T>> sources, const ImageView<T>& out,
         const ImageView<std::uint8_t>& validity, int x, int y)
      : out_(out.row(y) + Channels * x),
        out_stride_(out.stride),
        valid_(validity.row(y) + x),
        valid_stride_(validity.stride) {
    for (std::size_t n = 0; n < Count; ++n) {
      in_.picture[n] = sources[n].picture.row(y) + Channels * x;
      in_.weights[n] = sources[n].weights.row(y) + x;
      picture_stride_[n] = sources[n].picture.stride;
      weights_stride_[n] = sources[n].weights.stride;
    }
  }

  template <class Rule>
  [[gnu::always_inline]] void merge_run() const {
    Bytes seen;
    Rule::template run<Channels>(in_, out_, seen);
    const Bytes all_seen = Bytes{} + kSeen;
    store(seen != 0 ? all_seen : load<Bytes>(valid_), valid_);
  }

  template <class Rule>
  [[gnu::noinline]] void merge_cut_run(int columns) const {
    const CutRun<T, Channels, Count> cut(in_, columns);
    Samples<T, Channels> merged;
    Bytes seen;
    Rule::template run<Channels>(cut.runs, merged.data(), seen);
    std::copy_n(merged.begin(), columns * Channels, out_);
    for (int i = 0; i < columns; ++i) valid_[i] = seen[i] != 0 ? kSeen : valid_[i];
  }

  [[gnu::always_inline]] void go_down() {
    for (std::size_t n = 0; n < Count; ++n) {
      in_.picture[n] += picture_stride_[n];
      in_.weights[n] += weights_stride_[n];
    }
    out_ += out_stride_;
    valid_ += valid_stride_;
  }

 private:
  SourceRuns<T, Count> in_;
  std::array<std::ptrdiff_t, Count> picture_stride_{}, weights_stride_{};
  T* out_;
  std::ptrdiff_t out_stride_;
  std::uint8_t* valid_;
  std::ptrdiff_t valid_stride_;
};

template <class Rule, int Channels, std::size_t Count, class T>
void merge_rows(std::span<const MergeSource<T>> sources, const ImageView<T>& out,
                const ImageView<std::uint8_t>& validity, TileRows rows) {
  const int first = rows.first * kTile, last = std::min(rows.last * kTile, out.height);
  for (int x = 0; x < out.width; x += kRun) {
    const int columns = std::min(kRun, out.width - x);
    Column<T, Channels, Count> column(sources, out, validity, x, first);
    for (int y = first; y < last; ++y, column.go_down()) {
      columns == kRun ? column.template merge_run<Rule>()
                      : column.template merge_cut_run<Rule>(columns);
    }
  }
}

template <class Rule, class T>
void merge_by(std::span<const MergeSource<T>> sources, const ImageView<T>& out,
              const ImageView<std::uint8_t>& validity, TileRows rows) {
  assert(sources.size() <= kMaxSources);
  assert(out.channels == 1 || out.channels == 3);
  const auto merge_some = [&]<int Channels>(std::integral_constant<int, Channels>) {
    switch (sources.size()) {
      case 1:
        return merge_rows<Rule, Channels, 1>(sources, out, validity, rows);
      case 2:
        return merge_rows<Rule, Channels, 2>(sources, out, validity, rows);
      case 3:
        return merge_rows<Rule, Channels, 3>(sources, out, validity, rows);
      case 4:
        return merge_rows<Rule, Channels, 4>(sources, out, validity, rows);
      default:
        return merge_rows<Rule, Channels, 0>(sources, out, validity, rows);
    }
  };
  out.channels == 1 ? merge_some(std::integral_constant<int, 1>{})
                    : merge_some(std::integral_constant<int, 3>{});
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
