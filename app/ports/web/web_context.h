// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "app/model/command/command_path.h"
#include "app/model/configuration/program.h"
#include "app/model/machine/machine_state.h"
#include "app/model/sink/interface_metric.h"
#include "app/model/sink/interface_table.h"
#include "app/model/sink/published.h"
#include "app/model/sink/recorded_regions.h"
#include "app/model/status/measured_recipe.h"
#include "app/model/status/status_report.h"
#include "hal/thread/shared_threads.h"
#include "proc/optics/scene_proxy.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {

class AlignmentSource;
class Fleet;
class RecordedEvents;
class RecordedExports;
class RecordedReplays;

/// Parts of the appliance that only the page shows.
struct PageContext {
  optics::Ball ball;         ///< machine frame, mm
  optics::SceneProxy scene;  ///< around it
  /// The room in each camera's whole picture, by camera; null: not to be looked around in.
  std::vector<std::shared_ptr<const optics::ViewProjection>> balls;
  std::vector<MeasuredRecipe> recipes;                 ///< what is measured
  AlignmentSource* alignment = nullptr;                ///< outlives the sink's run; null: none
  std::shared_ptr<RecordedEvents> events = nullptr;    ///< null: none are recorded
  RecordedRegionsReader regions = nullptr;             ///< of their recipes
  std::shared_ptr<RecordedExports> exports = nullptr;  ///< null: no events are recorded
  std::shared_ptr<RecordedReplays> replays = nullptr;  ///< null: no events are recorded
  std::filesystem::path state_folder;  ///< of what must outlast a restart; empty: no users
  Program program;                     ///< around the appliance
  /// Tables about all sinks; callable on any thread while they run. Empty function: none.
  std::function<std::vector<InterfaceTable>()> tables = nullptr;
  /// Counters of all sinks, under the same rule.
  std::function<std::vector<InterfaceMetric>()> metrics = nullptr;
};

/// What the page is made with, besides its settings.
struct WebContext : PageContext {
  StatusNames names;
  std::vector<PublishedView> views;  ///< by place in names.views
  CommandPath commands;
  std::shared_ptr<hal::SharedThreads> background;  ///< for encoders
  std::shared_ptr<Fleet> fleet = nullptr;          ///< who is heard over DDS; null: nobody
  MachinePath machine = {};                        ///< of states that scripts send
};

}  // namespace orbwatch::app
