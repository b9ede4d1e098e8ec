// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "app/model/sink/sink.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

struct SnapshotSettings {
  static constexpr std::string_view kName = "snapshot", kText = "Pictures on command";

  std::filesystem::path folder;  ///< empty: there are no snapshots
  int keep = 100;                ///< snapshots on the disk
};

template <class Visitor>
void visit(Visitor& v, SnapshotSettings& snapshot) {
  v.required("folder", snapshot.folder,
             "Folder for the PNG pictures of the command snapshot; a folder outside the state "
             "folder needs ReadWritePaths= in the unit");
  v.optional("keep", snapshot.keep, Range::between(1, 100000),
             "Number of snapshots kept; a further one deletes the oldest");
}

/// Null without a folder.
std::unique_ptr<Sink> make_sink(const SnapshotSettings& settings);

}  // namespace orbwatch::app
