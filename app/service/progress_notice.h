// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "app/model/sink/sink.h"
#include "hal/clock.h"
#include "hal/thread/mailbox.h"
#include "hal/thread/thread.h"

namespace orbwatch::app {

/// Forwards the pipeline's progress to the service manager: its first status makes the service
/// ready, later ones feed the watchdog, four times in its period. Nothing else feeds it, and it is
/// not fed while the process is unsupervised, even if the pipeline works.
class ProgressNotice : public Sink {
 public:
  /// The service's status states the system's state and whether an interface has a fault, then
  /// `remark`, if any. The pipeline calls `is_supervised`; null: always supervised.
  explicit ProgressNotice(std::string remark = {}, std::function<bool()> is_supervised = nullptr);
  ~ProgressNotice() override { stop(); }

  Result<> start() override;
  void stop() override;
  void accept(const ViewPtr& /*view*/) override {}
  void accept(const Status& status) override;

 private:
  /// Copied to the thread that sends.
  struct Progress {
    SystemState state;
    std::uint32_t interface_faults;
    bool operator==(const Progress&) const = default;
  };

  std::string text(const Progress& progress) const;
  void send();

  const std::string remark_;
  const std::function<bool()> is_supervised_;
  const hal::Clock::duration pause_;  ///< pause between two messages of the same progress
  // Progress that was sent last; used by the pipeline's thread only.
  std::optional<Progress> last_;
  hal::TimePoint sent_{};

  hal::Mailbox<Progress> progress_;
  hal::Thread thread_;  ///< sends the messages, which may wait for their reader
};

}  // namespace orbwatch::app
