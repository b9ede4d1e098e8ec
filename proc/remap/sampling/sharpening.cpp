// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/sharpening.h"

#include <algorithm>
#include <cassert>

#include "proc/remap/sampling/sharpen_run.h"

namespace orbwatch::remap {
namespace {

/// Sharpens a sample anywhere, including the picture's border.
std::uint8_t sharpened_at(const RowsAround& rows, int i, std::int16_t gain) {
  const auto& [above, row, below, samples, step] = rows;
  const int left = i < step ? i : i - step, right = i + step < samples ? i + step : i;
  return sharpened_sample(row[i], above[i] + below[i] + row[left] + row[right],
                          above[left] + above[right] + below[left] + below[right], gain);
}

}  // namespace

void sharpen_row(const RowsAround& rows, const SharpeningGains& gains, int first, int last,
                 std::uint8_t* out) {
  assert(0 <= first && last <= rows.samples);
  const auto sharpen_each = [&](int begin, int end) {
    for (int i = begin; i < end; ++i) out[i] = sharpened_at(rows, i, gains[i % 2]);
  };
  // Bounds are even, so that a run begins with the first gain.
  const int begin = (std::max(first, rows.pixel_samples) + 1) / 2 * 2;
  const int end = std::min(last, rows.samples - rows.pixel_samples) / 2 * 2;
  if (end - begin < kSharpenedRun) return sharpen_each(first, last);
  sharpen_each(first, begin);
  const RunSharpener sharpen(rows, gains);
  int i = begin;
  for (; i + kSharpenedRun <= end; i += kSharpenedRun) sharpen(i, out);
  // The last run overlaps the one before.
  if (i < end) sharpen(end - kSharpenedRun, out);
  sharpen_each(end, last);
}

}  // namespace orbwatch::remap
