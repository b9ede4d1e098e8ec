// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/figure_file.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/model/status/status.h"
#include "app/ports/web/api/record_schema.h"
#include "hal/atomic_file.h"
#include "hal/boot_id.h"
#include "hal/regular_file.h"

namespace orbwatch::app::web {
namespace {

namespace fs = std::filesystem;

/// More than the largest history takes.
constexpr std::size_t kMostBytes = std::size_t{16} << 20;

struct FileTrack {
  std::string kind, name;
  std::vector<std::string> figures;
};
template <class Visitor>
void visit(Visitor& v, FileTrack& track) {
  v.required("kind", track.kind, "region or camera");
  v.required("name", track.name, "Name of the component");
  v.required("figures", track.figures, "Names of its figures, in the order of their steps");
}

struct FileHead {
  std::string boot;
  std::int64_t end_since_boot = 0;
  std::int64_t end = 0;
  std::size_t steps = 0;
  std::vector<FileTrack> tracks;
};
template <class Visitor>
void visit(Visitor& v, FileHead& head) {
  v.required("boot", head.boot, "hal::boot_id()");
  // Within 64 bits.
  v.required("end_since_boot", head.end_since_boot, Range::between(0, 9e18),
             "End of the newest step by hal::Clock", "ns");
  v.required("end", head.end, Range::between(0, 9e18), "End of the newest step, UTC", "ns");
  v.required("steps", head.steps, Range::between(0, FigureHistory::kSteps), "Number of steps");
  v.required("tracks", head.tracks, "Components");
}

Result<FileHead> head_of(const std::string& line, const std::string& file) {
  const Json json = Json::parse(line, nullptr, false);
  if (json.is_discarded()) return fail(file + ": its first line is not JSON");
  return check_form(json, schema_of<FileHead, Sent::ByUs>(), file).and_then([&] {
    return record_of<FileHead>(json);
  });
}

/// Age of the newest step: by the kernel's clock within a boot, which no correction of UTC changes.
/// Nothing after another boot while UTC is not certain: without a battery the clock continues where
/// it was at power-off, and old figures would count as recent.
std::optional<hal::Clock::duration> age_of(const FileHead& head, bool is_utc_certain) {
  using std::chrono::nanoseconds;
  if (!head.boot.empty() && head.boot == hal::boot_id()) {
    return hal::Clock::now().time_since_epoch() - nanoseconds(head.end_since_boot);
  }
  if (!is_utc_certain) return std::nullopt;
  return std::chrono::system_clock::now().time_since_epoch() - nanoseconds(head.end);
}

/// Takes the steps from the front of `bytes`, which has them.
std::vector<Extremes> take_steps(std::string_view& bytes, std::size_t count) {
  std::vector<Extremes> steps(count);
  std::memcpy(steps.data(), bytes.data(), count * sizeof(Extremes));
  bytes.remove_prefix(count * sizeof(Extremes));
  return steps;
}

/// Error: not as many bytes as the head states; more components than there can be.
Result<std::vector<FigureHistory::Kept>> kept_of(const FileHead& head, std::string_view bytes,
                                                 const std::string& file) {
  std::size_t figures = 0;
  const auto is_region = [](const FileTrack& track) { return track.kind == "region"; };
  for (const FileTrack& track : head.tracks) figures += track.figures.size();
  const auto regions = static_cast<std::size_t>(std::ranges::count_if(head.tracks, is_region));
  if (bytes.size() != figures * head.steps * sizeof(Extremes) || regions > signals::kMaxRegions ||
      head.tracks.size() - regions > kMaxCameras) {
    return fail(file + ": is damaged");
  }
  std::vector<FigureHistory::Kept> kept;
  for (const FileTrack& track : head.tracks) {
    FigureHistory::Kept& one = kept.emplace_back(
        FigureHistory::Kept{{is_region(track) ? "region" : "camera", track.name}, {}});
    for (const std::string& figure : track.figures) {
      one.figures[figure] = take_steps(bytes, head.steps);
    }
  }
  return kept;
}

}  // namespace

Result<> write_figures(const fs::path& file, const FigureHistory& history) {
  FileHead head;
  head.boot = hal::boot_id();
  std::string bytes;
  for (const Component& component : history.components()) {
    FileTrack& track =
        head.tracks.emplace_back(FileTrack{std::string(component.kind), component.name, {}});
    for (const std::string_view figure : FigureHistory::figure_names(component.kind)) {
      const auto series = history.series(component, figure);
      if (!series) continue;
      track.figures.emplace_back(figure);
      head.steps = series->steps.size();
      head.end_since_boot = std::chrono::nanoseconds(series->end.time_since_epoch()).count();
      head.end = std::chrono::nanoseconds(hal::to_utc(series->end).time_since_epoch()).count();
      const auto as_bytes = std::as_bytes(std::span(series->steps));
      bytes.append(reinterpret_cast<const char*>(as_bytes.data()), as_bytes.size());
    }
  }
  return hal::write_file(file, json_text(json_of(head)) + "\n" + bytes, hal::FileAccess::Owner);
}

Result<> resume_figures(const fs::path& file, FigureHistory& history, bool is_utc_certain) {
  std::error_code none;
  if (!fs::exists(file, none) && !none) return {};
  const auto text = hal::read_regular_file(file, kMostBytes);
  if (!text) return tl::unexpected(text.error());
  const std::size_t line = text->find('\n');
  const auto head = head_of(text->substr(0, line), file.string());
  if (!head) return tl::unexpected(head.error());
  const auto bytes = std::string_view(*text).substr(std::min(line, text->size() - 1) + 1);
  const auto kept = kept_of(*head, bytes, file.string());
  if (!kept) return tl::unexpected(kept.error());
  const auto age = age_of(*head, is_utc_certain);
  if (!age) {
    return fail(file.string() +
                ": from before this boot, and no time server has set the clock yet");
  }
  if (*age < hal::Clock::duration::zero()) return fail(file.string() + ": ends in the future");
  if (*age >= FigureHistory::kStep * FigureHistory::kSteps) return {};
  const auto now = hal::Clock::now();
  history.resume(*kept, now - *age, now);
  return {};
}

}  // namespace orbwatch::app::web
