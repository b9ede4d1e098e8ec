#pragma once

#include <iosfwd>
#include <memory>
#include <mutex>
#include <string_view>

#include "app/model/sink.h"
#include "app/model/status_report.h"
#include "hal/thread/thread.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

struct ConsoleSettings {
  static constexpr std::string_view kName = "console", kText = "Figures on standard output";

  bool enabled = false;
  double period = 1;  ///< s
};

template <class Visitor>
void visit(Visitor& v, ConsoleSettings& console) {
  v.optional("enabled", console.enabled, "Print the status to standard output");
  v.optional("period", console.period, Range::between(0.1, 3600), "Seconds between two prints");
}

/// Prints every component of the status with its values, once a period and when it stops.
class ConsoleSink final : public Sink {
 public:
  ConsoleSink(ConsoleSettings settings, StatusNames names, std::ostream& out);
  ~ConsoleSink() override;

  Result<> start() override;
  void stop() override;
  std::chrono::nanoseconds cpu_time() const override { return thread_.cpu_time(); }
  void accept(const ViewPtr&) override {}
  void accept(const Status& status) override;

 private:
  void print(hal::TimePoint now);

  ConsoleSettings settings_;
  StatusNames names_;
  std::ostream& out_;
  hal::TimePoint started_;
  std::mutex mutex_;
  Status status_;
  hal::Thread thread_;
};

/// Nobody commands by it.
inline std::string commanders(const ConsoleSettings& /*settings*/) { return {}; }

std::unique_ptr<Sink> make_sink(const ConsoleSettings& settings, const SinkContext& context);

}  // namespace orbwatch::app
