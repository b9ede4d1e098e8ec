// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string_view>

#include "app/model/sink/sink.h"
#include "app/model/status/status_report.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

struct ConsoleSettings {
  static constexpr std::string_view kName = "console", kText = "Status figures on standard output";

  bool enabled = false;
  double period = 1;  ///< s
};

template <class Visitor>
void visit(Visitor& v, ConsoleSettings& console) {
  v.optional("enabled", console.enabled, "Print the status to standard output");
  v.optional("period", console.period, Range::between(0.1, 3600), "Interval between two prints, s");
}

std::unique_ptr<Sink> make_sink(const ConsoleSettings& settings, const StatusNames& names);

}  // namespace orbwatch::app
