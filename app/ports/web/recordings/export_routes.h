// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <utility>

#include "app/ports/web/api/changes.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/recordings/export_records.h"

namespace orbwatch::app::web {

/// Serves exports of the recorder's events, which are made while it runs. Thread rule: start and
/// stop by one owner; everything else on any thread.
class ExportRoutes {
 public:
  /// `exports` null: no events are recorded. `changes`: the thread that waits for the disk;
  /// outlives it.
  ExportRoutes(std::shared_ptr<RecordedExports> exports, Changes& changes)
      : exports_(std::move(exports)), changes_(changes) {}

  void start() const;
  void stop() const;
  std::chrono::nanoseconds cpu_time() const;

  /// Without a recorder, as before the first export.
  Answered<ExportStatus> status() const;
  /// Sends the finished file once: it is removed when it is open.
  void file(const ExportNumber& query, const ExchangePtr& exchange) const;
  Answered<ExportNumber> begin(Change<ExportBody>& change) const;
  /// Exports of others are cancelled by operators.
  Answered<Done> cancel(Change<ExportNumber>& change) const;

 private:
  const std::shared_ptr<RecordedExports> exports_;
  Changes& changes_;
};

}  // namespace orbwatch::app::web
