// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/recent_log.h"
#include "proc/settings/settings.h"

/// Records of the log.
namespace orbwatch::app::web {

inline constexpr std::array kLogLevels{
    Word{"error", LogLevel::Error},
    Word{"warning", LogLevel::Warning},
    Word{"info", LogLevel::Info},
};

struct LogQuery {
  RecentLog::Wanted wanted{200};
};
template <class Visitor>
void visit(Visitor& v, LogQuery& query) {
  v.optional("lines", query.wanted.most, "Limit of lines; at most 1000 are kept");
  v.optional("level", query.wanted.least, kLogLevels, "Least severity");
  v.optional("after", query.wanted.after,
             "Number of the last line already read; only later lines are returned");
}

struct SentLine {
  std::uint64_t number = 0;
  std::string time;
  LogLevel level = LogLevel::Info;
  std::string text;
  std::optional<std::string> camera, fault;
  std::optional<std::uint64_t> trigger;
};
template <class Visitor>
void visit(Visitor& v, SentLine& line) {
  v.required("number", line.number, "Counted from 1");
  v.required("time", line.time, "UTC, ISO 8601");
  v.required("level", line.level, kLogLevels, "Severity");
  v.required("text", line.text, "The line");
  v.optional("camera", line.camera, "Name of the camera that it concerns");
  v.optional("fault", line.fault, "Fault of the camera, also if it has ended");
  v.optional("trigger", line.trigger, "Number of the trigger that it concerns");
}

struct LogAnswer {
  std::string started;
  std::uint64_t newest = 0;
  std::vector<SentLine> lines;
};
template <class Visitor>
void visit(Visitor& v, LogAnswer& answer) {
  v.required("started", answer.started,
             "Start of the program, UTC, ISO 8601; lines are counted from it");
  v.required("newest", answer.newest, "Number of the newest line of all");
  v.required("lines", answer.lines, "Selected lines, oldest first");
}

}  // namespace orbwatch::app::web
