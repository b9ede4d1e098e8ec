#pragma once

#include <condition_variable>
#include <iosfwd>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/config/configuration.h"
#include "app/pipeline/sink.h"

namespace orbwatch::app {

/// Prints a line of figures per period, and a summary when it stops.
class ConsoleSink final : public Sink {
 public:
  ConsoleSink(ConsoleSettings settings, std::vector<std::string> cameras,
              std::vector<std::string> views, std::ostream& out);
  ~ConsoleSink() override;

  Result<> start() override;
  void stop() override;
  void accept(const ViewPtr&) override {}
  void accept(const Status& status) override;

 private:
  void run();
  Status status() const;

  ConsoleSettings settings_;
  std::vector<std::string> cameras_;
  std::vector<std::string> views_;
  std::ostream& out_;
  hal::TimePoint started_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  Status status_;
  std::thread thread_;
};

}  // namespace orbwatch::app
