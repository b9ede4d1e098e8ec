// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "app/digest/sha256.h"
#include "app/model/configuration/configuration_files.h"
#include "app/model/configuration/device_files.h"
#include "app/model/configuration/device_update.h"
#include "app/ports/web/api/changes.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/device/device_records.h"

namespace orbwatch::app::web {

/// Handlers of support file, backup, restore, factory reset and updates. A file is made by a
/// change, which the audit records, and then downloaded. Thread-safe; all wait for the disk and for
/// another program.
class DeviceDesk {
 public:
  /// Texts of the running program for a support file; called on the thread of changes.
  using Figures = std::function<DeviceFiles::Figures()>;

  /// `device` null: all requests for files are refused. `update` null: those for updates.
  /// `files` null: nothing can be on trial. `changes` is the thread that waits; it outlives the
  /// desk.
  DeviceDesk(std::shared_ptr<DeviceFiles> device, std::shared_ptr<DeviceUpdate> update,
             std::shared_ptr<ConfigurationFiles> files, Figures figures, Changes& changes)
      : device_(std::move(device)),
        update_(std::move(update)),
        files_(std::move(files)),
        figures_(std::move(figures)),
        changes_(changes) {}

  Answered<MadeAnswer> make_support(Change<SupportBody>& change);
  Answered<MadeAnswer> make_backup(Change<BackupBody>& change);
  void download(const DeviceFileQuery& query, const ExchangePtr& exchange);
  Answered<UploadAnswer> upload(Change<UploadBody>& change);
  Answered<CheckAnswer> check(Change<DeviceFiles::Restore>& change);
  Answered<ContentsAnswer> restore(Change<RestoreBody>& change);
  Answered<Done> reset(Change<ResetBody>& change);
  void update(const ExchangePtr& exchange);
  Answered<UploadAnswer> upload_update(Change<UploadUpdateBody>& change);
  Answered<Done> install_update(Change<Nothing>& change);
  Answered<Done> restart_device(Change<Nothing>& change);

  /// Ends a call under way with an error, before its thread is stopped.
  void cancel();

 private:
  Answered<MadeAnswer> keep(DeviceFile kind, const Result<DeviceFiles::Made>& made);
  Answered<Nothing> check_replaceable() const;

  const std::shared_ptr<DeviceFiles> device_;
  const std::shared_ptr<DeviceUpdate> update_;
  const std::shared_ptr<ConfigurationFiles> files_;
  const Figures figures_;
  Changes& changes_;
  /// Paths of made files by kind; used on the thread of changes only.
  std::shared_ptr<std::map<DeviceFile, std::filesystem::path>> made_ =
      std::make_shared<std::map<DeviceFile, std::filesystem::path>>();
  Sha256 uploaded_;  ///< of the uploaded backup; used on the thread of changes only
};

}  // namespace orbwatch::app::web
