// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "app/cli/bench/bench_figures.h"
#include "app/cli/text_table.h"
#include "app/model/status/json.h"

namespace orbwatch::app::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string ms_text(double value) { return fixed_text(value, 2); }
std::string mebibytes(double value) { return fixed_text(value, 1); }

/// Share of one core, in percent.
double load_of(const ThreadLoad& thread, const BenchFigures& figures) {
  return 100 * std::chrono::duration<double>(thread.time).count() / figures.seconds;
}

/// Threads with the same name are one line: a library may have many.
std::vector<Fields> thread_records(const BenchFigures& figures) {
  std::map<std::string, std::pair<int, double>> by_name;
  for (const ThreadLoad& thread : figures.threads) {
    auto& [count, load] = by_name[thread.name];
    ++count;
    load += load_of(thread, figures);
  }
  std::vector<std::pair<std::string, std::pair<int, double>>> sorted(by_name.begin(),
                                                                     by_name.end());
  std::ranges::stable_sort(sorted, std::ranges::greater(),
                           [](const auto& entry) { return entry.second.second; });
  std::vector<Fields> records;
  records.reserve(sorted.size());
  for (const auto& [name, figure] : sorted) {
    records.push_back({{"thread", name},
                       {"threads", std::to_string(figure.first)},
                       {"load_%", fixed_text(figure.second, 1)}});
  }
  return records;
}

std::vector<Fields> stage_records(const BenchFigures& figures) {
  std::vector<Fields> records;
  for (std::size_t i = 0; i < kStages; ++i) {
    records.push_back({{"stage", std::string(name_of(static_cast<Stage>(i)))},
                       {"p50_ms", ms_text(figures.stages[i].p50)},
                       {"p99_ms", ms_text(figures.stages[i].p99)},
                       {"mean_ms", ms_text(figures.means[i])}});
  }
  return records;
}

std::vector<Fields> view_records(const BenchFigures& figures) {
  std::vector<Fields> records;
  for (const auto& view : figures.views) {
    records.push_back({{"view", view.name},
                       {"size", std::to_string(view.width) + "x" + std::to_string(view.height)},
                       {"published", std::to_string(view.published)},
                       {"skipped", std::to_string(view.skipped)},
                       {"latency_p50_ms", ms_text(view.latency.p50)},
                       {"latency_p99_ms", ms_text(view.latency.p99)}});
  }
  return records;
}

Json json_of(const Percentiles& percentiles) {
  return {{"p50_ms", to_json(percentiles.p50)}, {"p99_ms", to_json(percentiles.p99)}};
}

}  // namespace

std::string bench_text(const BenchFigures& figures, const Verdict& verdict) {
  std::string text = std::to_string(figures.frame_sets) + " frame sets in " +
                     fixed_text(figures.seconds, 1) + " s, " + fixed_text(figures.wanted_rate, 2) +
                     " per second wanted, " + std::to_string(figures.overruns) + " late; " +
                     std::to_string(figures.cores) + " cores, " +
                     (figures.realtime ? "real-time" : "no real-time") + " priorities, memory " +
                     (figures.memory_locked ? "locked" : "not locked") + "\n";
  for (const auto& camera : figures.cameras) {
    text += "camera " + camera.name + ": " + camera.format + ", " + std::to_string(camera.dropped) +
            " frames not used\n";
  }
  text += "\nProcessor time per frame set, of all threads together:\n" +
          record_lines(stage_records(figures)) + "of it the pipeline's thread: p50 " +
          ms_text(figures.busy.p50) + " ms, p99 " + ms_text(figures.busy.p99) +
          " ms\n\nExposure start to publication:\n" + record_lines(view_records(figures)) +
          "\nLoad of the threads, of one core:\n" + record_lines(thread_records(figures));
  const MemoryFigures& memory = figures.memory;
  text += "\nMemory, MiB: resident " + mebibytes(memory.resident) + ", at most " +
          mebibytes(memory.peak) + "; of it views, grids and own buffers " +
          mebibytes(memory.anonymous) + ", programs " + mebibytes(memory.file) +
          ", drivers' and shared " + mebibytes(memory.shared) + "\n\n";
  return text + verdict.sentence + "\n";
}

std::string bench_json(const BenchFigures& figures, const Verdict& verdict) {
  Json stages = Json::array(), views = Json::array(), threads = Json::array();
  Json cameras = Json::array();
  for (std::size_t i = 0; i < kStages; ++i) {
    Json stage{{"name", name_of(static_cast<Stage>(i))}};
    stage.update(json_of(figures.stages[i]));
    stage["mean_ms"] = to_json(figures.means[i]);
    stages.push_back(std::move(stage));
  }
  for (const auto& view : figures.views) {
    views.push_back({{"name", view.name},
                     {"width", view.width},
                     {"height", view.height},
                     {"published", view.published},
                     {"skipped", view.skipped},
                     {"latency", json_of(view.latency)}});
  }
  for (const ThreadLoad& thread : figures.threads) {
    threads.push_back(
        {{"id", thread.id}, {"name", thread.name}, {"load", load_of(thread, figures) / 100}});
  }
  for (const auto& camera : figures.cameras) {
    cameras.push_back(
        {{"name", camera.name}, {"format", camera.format}, {"dropped", camera.dropped}});
  }
  const MemoryFigures& memory = figures.memory;
  const Json all{{"fits", verdict.fits},
                 {"used", to_json(verdict.used)},
                 {"verdict", verdict.sentence},
                 {"seconds", to_json(figures.seconds)},
                 {"wanted_rate", to_json(figures.wanted_rate)},
                 {"frame_sets", figures.frame_sets},
                 {"overruns", figures.overruns},
                 {"cores", figures.cores},
                 {"realtime", figures.realtime},
                 {"memory_locked", figures.memory_locked},
                 {"busy", json_of(figures.busy)},
                 {"stages", std::move(stages)},
                 {"cameras", std::move(cameras)},
                 {"views", std::move(views)},
                 {"threads", std::move(threads)},
                 {"memory_mib",
                  {{"resident", to_json(memory.resident)},
                   {"peak", to_json(memory.peak)},
                   {"anonymous", to_json(memory.anonymous)},
                   {"file", to_json(memory.file)},
                   {"shared", to_json(memory.shared)},
                   {"locked", to_json(memory.locked)}}}};
  return all.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace orbwatch::app::cli
