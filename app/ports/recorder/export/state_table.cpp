// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/state_table.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "app/model/csv_text.h"
#include "app/ports/recorder/export/export_file.h"
#include "app/ports/recorder/export/state_values.h"
#include "app/ports/recorder/recorded_states.h"
#include "app/ports/recorder/recorded_utc.h"

namespace orbwatch::app::recorder {
namespace {

/// Bounds of what a recording of any origin makes a table keep.
constexpr std::size_t kMostColumns = 4096, kLongestTitle = 1024;

/// Calls `visit` for each state in the range. Errors: those of RecordedStates and of `visit`.
template <class Visit>
Result<> for_each_state(const std::filesystem::path& recording, const StampRange& range,
                        Visit&& visit) {
  auto states = RecordedStates::open(recording);
  if (!states) return tl::unexpected(states.error());
  while (true) {
    const auto state = states->next();
    if (!state) return tl::unexpected(state.error());
    if (!*state) return {};
    if (!range.has((*state)->utc)) continue;
    if (auto visited = visit(**state); !visited) return visited;
  }
}

/// Columns of values by their titles, in the order in which they appear.
class Columns {
 public:
  Result<> add(const ProcessState& state) {
    Result<> added;
    for_each_value(state, [&](const std::string& title, const Figure&) {
      if (!added || numbers_.contains(title)) return;
      if (title.size() > kLongestTitle) {
        added = fail("a region's name is longer than " + std::to_string(kLongestTitle) + " bytes");
      } else if (titles_.size() == kMostColumns) {
        added = fail("more than " + std::to_string(kMostColumns) +
                     " values; choose a smaller range by --from and --to");
      } else {
        numbers_.emplace(title, titles_.size());
        titles_.push_back(title);
      }
    });
    return added;
  }

  std::string head() const {
    std::string line = "utc,utc_ns,frame_set,trigger,recipe";
    for (const std::string& title : titles_) line += "," + csv_field(title);
    return line + "\n";
  }

  std::string row(const RecordedState& recorded) const {
    const ProcessState& state = recorded.state;
    std::vector<std::string> cells(titles_.size());
    for_each_value(state, [&](const std::string& title, const Figure& figure) {
      cells[numbers_.at(title)] = value_text(figure);
    });
    std::string line = utc_text_at(recorded.utc) + "," + std::to_string(recorded.utc) + "," +
                       std::to_string(state.frame_set) + "," +
                       (state.trigger == 0 ? "" : std::to_string(state.trigger)) + "," +
                       std::to_string(state.recipe);
    for (const std::string& cell : cells) line += "," + csv_field(cell);
    return line + "\n";
  }

 private:
  std::vector<std::string> titles_;
  std::map<std::string, std::size_t> numbers_;
};

}  // namespace

Result<> write_state_table(const std::filesystem::path& recording, const StampRange& range,
                           const std::filesystem::path& output, const ExportSteps& steps) {
  Columns columns;
  const auto known = for_each_state(
      recording, range, [&](const RecordedState& recorded) { return columns.add(recorded.state); });
  if (!known) return fail(recording.string() + ": " + known.error().message);
  auto file = ExportFile::create(output);
  if (!file) return tl::unexpected(file.error());
  if (auto written = file->append(columns.head()); !written) return written;
  std::size_t rows = 0;
  return for_each_state(recording, range,
                        [&](const RecordedState& recorded) -> Result<> {
                          if (!steps(rows++, range.sets, "frame sets")) return cancelled_export();
                          return file->append(columns.row(recorded));
                        })
      .and_then([&] { return file->sync(); });
}

}  // namespace orbwatch::app::recorder
