// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "app/files/camera_settings.h"
#include "app/files/toml/finding.h"
#include "app/machine/machine_settings.h"
#include "app/model/alignment/place_settings.h"
#include "app/pipeline/measurement/recipe.h"
#include "app/pipeline/pipeline_settings.h"
#include "app/pipeline/views/view_settings.h"
#include "app/ports/console/console_settings.h"
#include "app/ports/dds/dds_settings.h"
#include "app/ports/lines/line_settings.h"
#include "app/ports/modbus/modbus_settings.h"
#include "app/ports/recorder/recorder_settings.h"
#include "app/ports/snapshot/snapshot_settings.h"
#include "app/ports/web/web_settings.h"
#include "app/simulation/machine.h"
#include "hal/thread/thread_settings.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::files {

/// The list of sinks, one per line. A settings struct has the name and the meaning of its table as
/// kName and kText and its keys in visit(); make_sink() beside it makes the sink, or returns null
/// if it is not enabled. Its parameters name what the sink is made with, see SinkParts in
/// app/daemon/site/interfaces.cpp. Beside it stand, for a sink that
/// - takes commands: commanders(), the clients that may command through it;
/// - has keys or certificates: check_keys();
/// - has rules that its visit() does not check: check_settings();
/// - listens on TCP ports: listening_ports();
/// - records pictures: check_recorded(), records_pictures();
/// - serves a page: page_address();
/// - receives from other appliances, or shows them: fills_fleet(), shows_fleet().
using SinkSettings = std::tuple<ConsoleSettings,   //
                                ModbusSettings,    //
                                DdsSettings,       //
                                SnapshotSettings,  //
                                WebSettings,       //
                                RecorderSettings>;

/// Calls `use` with the settings of each sink, in the order of the list.
template <class Use>
void for_each_sink(const SinkSettings& sinks, Use&& use) {
  std::apply([&use](const auto&... settings) { (use(settings), ...); }, sinks);
}

/// File of a recipe, and the number that selects it.
struct RecipeFile {
  std::uint16_t number = 0;
  NamedFile file;
};

/// Contents of the file of `orbwatchd --config`: names, not indices. See resolve().
struct Configuration {
  NamedFile rig;
  pipeline::PipelineSettings pipeline;
  hal::ThreadSettings threads;
  simulation::MachineSettings simulation;
  std::vector<Located<CameraSettings>> cameras;
  std::vector<Located<LineSettings>> lines;
  std::vector<Located<pipeline::ViewSettings>> views;
  std::vector<Located<RecipeFile>> recipes;  ///< the first recipe is measured from the start
  machine::MachineSettings machine;
  PlaceSettings place;
  std::filesystem::path state_folder;  ///< empty: the file names none; see Resolved::state_folder
  SinkSettings sinks;
};

template <class Visitor>
void visit(Visitor& v, RecipeFile& recipe) {
  v.required("number", recipe.number, Range::between(1, 65535),
             "Number that the command select_recipe passes");
  v.required("file", recipe.file, "Recipe file; see [RECIPE.md](RECIPE.md)");
}

template <class Visitor>
void visit(Visitor& v, Configuration& configuration) {
  v.required("rig", configuration.rig,
             "Rig file with the geometry of cameras, ball and machine; see [RIG.md](RIG.md)");
  v.optional("state_folder", configuration.state_folder,
             "Folder for state that must survive a restart: command record, users, accepted "
             "alignments; default: systemd's STATE_DIRECTORY, else /var/lib/orbwatch-NAME for "
             "/etc/orbwatch/NAME/site.toml, /var/lib/orbwatch for any other file");
  v.table("pipeline", configuration.pipeline, "Frame budget and workers");
  v.table("threads", configuration.threads, "Scheduling and memory of the frame path");
  v.table("simulation", configuration.simulation, "Simulated machine that simulated cameras see");
  v.table("machine", configuration.machine,
          "States of the machine that its controller sends, associated with frame sets by time");
  v.tables("camera", configuration.cameras, 1, kMaxCameras,
           "Cameras; the first without a fault sets the pace");
  v.tables("line", configuration.lines, 0, 32, "Digital inputs and outputs");
  v.tables("view", configuration.views, 0, kMaxViews,
           "Display views: virtual cameras in the ball's centre that commands can point");
  v.tables("recipe", configuration.recipes, 0, pipeline::kMaxRecipes,
           "Recipes; the first one is selected at start");
  v.table(
      "place", configuration.place,
      "Accuracies and tags for the command place_camera. The ball's centre is taken from the rig, "
      "the outline from the alignment in force; `orbwatch place` estimates the centre, too");
  std::apply(
      [&v]<class... Sinks>(Sinks&... sinks) {
        (v.table(Sinks::kName.data(), sinks, Sinks::kText.data()), ...);
      },
      configuration.sinks);
}

/// Manual of all keys in Markdown.
std::string configuration_manual();

}  // namespace orbwatch::app::files
