// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/merge/merge.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <type_traits>

#include "proc/remap/colour/run_vector.h"

namespace orbwatch::remap {
namespace {

template <class T, int Channels>
using Samples = std::array<T, kRun * Channels>;

/// The largest dividend: 4 sources of weight 255 with the largest samples, and half of the divisor.
template <class T>
constexpr std::uint32_t kLargestSum =
    kMaxSources* UINT8_MAX* std::uint32_t{std::numeric_limits<T>::max()} + kMaxSources * 128;

/// floor(sum / total), exactly. The computed quotient errs by less than 2^-15. A quotient that is
/// not an integer lies at least 1 / total > 2^-10 below the next one, so that the margin lifts only
/// quotients that an error left below an integer.
template <class T>
T quotient(std::uint32_t sum, std::uint32_t total) {
  using Real = std::conditional_t<sizeof(T) == 1, float, double>;
  static_assert(kLargestSum<T> < (sizeof(T) == 1 ? 1U << 24 : 1U << 31));
  constexpr Real kMargin = Real{1} / 4096;
  // Vector units convert signed integers.
  const Real reciprocal = Real{1} / static_cast<Real>(static_cast<std::int32_t>(total));
  return static_cast<T>(static_cast<std::int32_t>(
      static_cast<Real>(static_cast<std::int32_t>(sum)) * reciprocal + kMargin));
}

/// Repeats the weights of a run's pixels for each of their samples.
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

/// One run as the weighted mean, 0 without any weight; `seen` becomes the pixels that some source
/// sees.
struct Mean {
  template <int Channels, class Runs, class T>
  [[gnu::always_inline]] static void run(const Runs& in, T* out, Bytes& seen) {
    const Words totals = totals_of(in);
    seen = narrowed(totals | totals >> 8);
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

/// A run that the border cuts, copied to memory of its own.
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

template <class Rule, int Channels, class T, std::size_t Count>
void merge_run(const SourceRuns<T, Count>& in, T* out, std::uint8_t* valid) {
  Bytes seen;
  Rule::template run<Channels>(in, out, seen);
  const Bytes all_seen = Bytes{} + kSeen;
  store(seen != 0 ? all_seen : load<Bytes>(valid), valid);
}

template <class Rule, int Channels, class T, std::size_t Count>
[[gnu::noinline]] void merge_cut_run(const SourceRuns<T, Count>& in, int columns, T* out,
                                     std::uint8_t* valid) {
  const CutRun<T, Channels, Count> cut(in, columns);
  Samples<T, Channels> merged;
  Bytes seen;
  Rule::template run<Channels>(cut.runs, merged.data(), seen);
  std::copy_n(merged.begin(), columns * Channels, out);
  for (int i = 0; i < columns; ++i) valid[i] = seen[i] != 0 ? kSeen : valid[i];
}

template <class Rule, int Channels, std::size_t Count, class T>
void merge_rows(std::span<const MergeSource<T>> sources, const ImageView<T>& out,
                const ImageView<std::uint8_t>& validity, TileRows rows) {
  const int last = std::min(rows.last * kTile, out.height);
  for (int y = rows.first * kTile; y < last; ++y) {
    for (int x = 0; x < out.width; x += kRun) {
      SourceRuns<T, Count> in;
      for (std::size_t n = 0; n < Count; ++n) {
        in.picture[n] = sources[n].picture.at(x, y);
        in.weights[n] = sources[n].weights.at(x, y);
      }
      const int columns = std::min(kRun, out.width - x);
      std::uint8_t* const valid = validity.at(x, y);
      columns == kRun ? merge_run<Rule, Channels>(in, out.at(x, y), valid)
                      : merge_cut_run<Rule, Channels>(in, columns, out.at(x, y), valid);
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
