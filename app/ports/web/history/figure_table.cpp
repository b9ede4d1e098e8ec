// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/figure_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "app/model/csv_text.h"
#include "app/model/status/utc_text.h"
#include "hal/clock.h"
#include "proc/signals/signals.h"

namespace orbwatch::app::web {
namespace {

/// Two columns of the table.
struct FigureColumns {
  std::string name;
  FigureHistory::Series series;
};

bool is_measured(const FigureHistory::Series& series) {
  return std::ranges::any_of(series.steps, [](const Extremes& step) {
    return signals::is_valid(static_cast<double>(step.low));
  });
}

std::vector<FigureColumns> columns_of(const FigureHistory& history) {
  std::vector<FigureColumns> columns;
  for (const Component& component : history.components()) {
    for (const std::string_view figure : FigureHistory::figure_names(component.kind)) {
      auto series = history.series(component, figure);
      if (!series || !is_measured(*series)) continue;
      std::string name(component.kind);
      name.append(" ").append(component.name).append(": ").append(figure);
      columns.push_back({std::move(name), std::move(*series)});
    }
  }
  return columns;
}

void add_number(std::string& table, double number) {
  table += ',';
  if (!signals::is_valid(number)) return;
  std::array<char, 32> text{};
  constexpr int kDigits = 6;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number,
                                 std::chars_format::general, kDigits);
  table.append(text.data(), end.ptr);
}

void add_head(std::string& table, const std::vector<FigureColumns>& columns) {
  table += "end";
  for (const auto& [name, series] : columns) {
    const std::string unit = series.unit.empty() ? "" : " (" + std::string(series.unit) + ")";
    for (const char* which : {" low", " high"}) {
      table.append(",").append(csv_field(std::string(name).append(which).append(unit)));
    }
  }
  table += "\r\n";
}

/// The step with this end; not measured where the series has none.
Extremes step_at(const FigureHistory::Series& series, hal::TimePoint end) {
  const auto before = (series.end - end) / FigureHistory::kStep;  // steps before the newest
  const auto size = static_cast<std::int64_t>(series.steps.size());
  if (end > series.end || before >= size) return {};
  return series.steps[static_cast<std::size_t>(size - 1 - before)];
}

}  // namespace

std::string figure_table(const FigureHistory& history) {
  const std::vector<FigureColumns> columns = columns_of(history);
  std::string table;
  add_head(table, columns);
  std::size_t steps = 0;
  hal::TimePoint end;
  for (const auto& [name, series] : columns) {
    steps = std::max(steps, series.steps.size());
    end = std::max(end, series.end);
  }
  for (std::size_t left = steps; left > 0; --left) {  // steps before the end, this one included
    const auto moment = end - static_cast<int>(left - 1) * FigureHistory::kStep;
    table += utc_text(hal::to_utc(moment)).value_or("");
    for (const auto& [name, series] : columns) {
      const Extremes step = step_at(series, moment);
      add_number(table, static_cast<double>(step.low));
      add_number(table, static_cast<double>(step.high));
    }
    table += "\r\n";
  }
  return table;
}

}  // namespace orbwatch::app::web
