// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/routes.h"

#include <algorithm>
#include <iterator>

#include "app/ports/web/access/access_desk.h"
#include "app/ports/web/align/align_routes.h"
#include "app/ports/web/api/http_manual.h"
#include "app/ports/web/api/typed_route.h"
#include "app/ports/web/commands/command_desk.h"
#include "app/ports/web/configuration/configuration_desk.h"
#include "app/ports/web/described_routes.h"
#include "app/ports/web/device/device_desk.h"
#include "app/ports/web/fleet/fleet_routes.h"
#include "app/ports/web/history/history_routes.h"
#include "app/ports/web/http/fixed_content.h"
#include "app/ports/web/interfaces/interface_routes.h"
#include "app/ports/web/log/log_routes.h"
#include "app/ports/web/look_around/look_around.h"
#include "app/ports/web/machine/machine_desk.h"
#include "app/ports/web/pixels/pixel_route.h"
#include "app/ports/web/process/recipe_routes.h"
#include "app/ports/web/recordings/export_routes.h"
#include "app/ports/web/recordings/recording_routes.h"
#include "app/ports/web/recordings/replay_routes.h"
#include "app/ports/web/status/openapi.h"
#include "app/ports/web/status/status_routes.h"
#include "app/ports/web/streams/live_stream.h"
#include "app/ports/web/streams/mjpeg_stream.h"
#include "app/ports/web/streams/stream_routes.h"
#include "app/ports/web/views/view_list.h"

namespace orbwatch::app::web {
namespace {

using enum Role;

/// Route of the description of all routes.
Route description_route() {
  Route route{"GET", "/api/v1/openapi.json", Viewer, "Returns the OpenAPI description",
              std::string(kJson)};
  route.answer = schema_of<Json, Sent::ByUs>;
  route.serve = [](const ExchangePtr& exchange) {
    // Made by the first request, and the same for all.
    static const FixedContent description(kJson, openapi_json(routes_of({})) + "\n");
    description.answer(exchange);
  };
  return route;
}

std::vector<Route> status_routes(const RouteOwners& of) {
  return {
      get<&StatusRoutes::health>(
          "/healthz", Nobody, of.status,
          "Returns 200 while the pipeline reports, else 503; the text is its state", kText),
      with_answer(get<&StatusRoutes::status>("/api/v1/status", Viewer, of.status,
                                             "Returns the complete status"),
                  status_schema),
      for_players(get<&StatusRoutes::metrics>(
          "/metrics", Viewer, of.status,
          "Returns the status and the counters of all interfaces for Prometheus", kMetrics)),
      get<&HistoryRoutes::figure>(
          "/api/v1/history", Viewer, of.history,
          "Returns the last ten minutes of one figure of a region or of a camera's supervision: "
          "lowest and highest value of each step, oldest first, null where it was not measured"),
      get<&HistoryRoutes::table>(
          "/api/v1/history/figures.csv", Viewer, of.history,
          "Returns the last ten minutes of all these figures as a table: a line for each step with "
          "its end, UTC, and lowest and highest value of each figure, empty where it was not "
          "measured",
          kCsv),
      get<&HistoryRoutes::alarms, AlarmsAnswer>(
          "/api/v1/history/alarms", Viewer, of.history,
          "Returns the newest events of alarms, oldest first, also those before a restart: time, "
          "value, limit, and who acknowledged"),
      get<&LogRoutes::lines>("/api/v1/log", Operator, of.log,
                             "Returns the newest lines of the log since the start, oldest first"),
  };
}

std::vector<Route> picture_routes(const RouteOwners& of) {
  return {
      get<&ViewList::list>(
          "/api/v1/views", Viewer, of.views,
          "Returns per view its direction, the weights of its cameras and the colours of "
          "one-channel ones, at present and as configured, and whether the commands point_view and "
          "mix_sources apply; and per colour map its colours, evenly spaced from the first value "
          "to the last"),
      for_players(get<&StreamRoutes::snapshot>("/snapshot.jpg", Viewer, of.streams,
                                               "Returns the view's next picture", kJpeg)),
      for_players(get<&StreamRoutes::stream>(
          "/stream.mjpg", Viewer, of.streams,
          "Streams the view's pictures as MJPEG, for players and recorders", MjpegStream::kType)),
      get<&StreamRoutes::live>(
          "/api/v1/live", Viewer, of.streams,
          "Streams status and views over one connection. Each message begins with a line of JSON "
          "that states its kind, for a picture the width and height of the view, in whose pixels "
          "all coordinates are, and the number of bytes that follow",
          LiveStream::kType),
      get<&PixelRoute::pixel, PixelAnswer>(
          "/api/v1/live/pixel", Viewer, of.pixels,
          "Returns the values at a pixel of a picture of the live stream: direction, intensity, "
          "temperature where a radiometric camera sees it, and the place on the scene. 410: the "
          "picture is not kept, request a newer one"),
      get<&LookAround::list>(
          "/api/v1/look-around", Viewer, of.look_around,
          "Returns the names of the balls' pictures, from which a browser draws views of the room: "
          "views of kind ball, and ball:CAMERA for each registered camera that none shows, at most "
          "four times a second; and of the views that the command point_view points"),
      get<&LookAround::mesh>(
          "/api/v1/sphere", Viewer, of.look_around,
          "Returns the room as a ball's picture shows it, as triangles with the pixels of their "
          "corners: a line of JSON with the number of bytes that follow. The ETag changes with the "
          "calibration",
          LookAround::kType),
  };
}

std::vector<Route> alignment_routes(const RouteOwners& of) {
  return {
      get<&AlignRoutes::state, AlignmentAnswer>(
          "/api/v1/alignment", Viewer, of.alignment,
          "Returns per camera the ball's outline, the pose, the proposal, the points with "
          "residuals, and the scene's edges as seen from the ball's centre and in the picture. The "
          "ETag changes with the answer"),
      get<&AlignRoutes::ball>(
          "/api/v1/alignment/ball.jpg", Viewer, of.alignment,
          "Returns a camera's next picture in full resolution; one channel is stretched between "
          "the 1st and the 99th percentile of its values, here and in views",
          kJpeg),
      get<&AlignRoutes::view>(
          "/api/v1/alignment/view.jpg", Viewer, of.alignment,
          "Returns the next perspective view from one camera alone, to judge its alignment", kJpeg),
      get<&AlignRoutes::pair>(
          "/api/v1/alignment/pair", Viewer, of.alignment,
          "Returns one view from the first camera, by its alignment in force, and from another "
          "one, made from frames of one set. Each begins with a line of JSON that states camera, "
          "time, age and the number of bytes of the JPEG file that follows. 409: a camera has no "
          "picture, or no frame set of 3 s has a new one of both",
          LiveStream::kType),
      get<&AlignRoutes::direction>(
          "/api/v1/alignment/direction", Viewer, of.alignment,
          "Returns the direction, seen from the ball's centre, of a pixel in a camera's picture, "
          "by the proposed alignment if there is one"),
      get<&RecipeRoutes::recipe>(
          "/api/v1/recipe", Viewer, of.recipe,
          "Returns the regions of a recipe with corners and outlines in their views, and limits of "
          "alarms. The number is 0 if there is no recipe"),
      get<&RecipeRoutes::polygon>(
          "/api/v1/recipe/polygon", Viewer, of.recipe,
          "Returns the polygon whose corners are these pixels of a view of the recipe: as "
          "directions, as points on the scene's surface, and its outline in the view"),
  };
}

std::vector<Route> access_routes(const RouteOwners& of) {
  return {
      get<&AccessDesk::session>(
          "/api/v1/session", Nobody, of.access,
          "Returns the caller's identity and rights, and whether there are users"),
      post<&AccessDesk::login, &AccessDesk::refuse_login>("/api/v1/login", Nobody, of.access,
                                                          of.access_changes,
                                                          "Starts a session, kept in a cookie"),
      post<&AccessDesk::set_first_password, &AccessDesk::refuse_first_password>(
          "/api/v1/set_first_password", Nobody, of.access, of.access_changes,
          "Creates the first administrator, admin, while there are no users, and starts a session"),
      post<&AccessDesk::logout>("/api/v1/logout", Viewer, of.access, of.access_changes,
                                "Ends the session"),
      post<&AccessDesk::set_password>(
          "/api/v1/set_password", Viewer, of.access, of.access_changes,
          "Changes the password of the logged-in user; the user's other sessions end"),
      get<&AccessDesk::audit, AuditAnswer>("/api/v1/audit", Administrator, of.access,
                                           "Returns the newest entries of the audit, newest last"),
      get<&AccessDesk::users>("/api/v1/users", Administrator, of.access,
                              "Returns users and programs, with roles"),
      post<&AccessDesk::set_user>(
          "/api/v1/set_user", Administrator, of.access, of.access_changes,
          "Adds a user or changes role or password; the first user must be administrator"),
      post<&AccessDesk::remove_user>("/api/v1/remove_user", Administrator, of.access,
                                     of.access_changes, "Removes a user"),
      post<&AccessDesk::create_token>(
          "/api/v1/create_token", Administrator, of.access, of.access_changes,
          "Creates a token for a program; the token is returned only once"),
      post<&AccessDesk::revoke_token>("/api/v1/revoke_token", Administrator, of.access,
                                      of.access_changes, "Revokes the token of a program"),
  };
}

std::vector<Route> configuration_routes(const RouteOwners& of) {
  return {
      get<&ConfigurationDesk::show, ConfigurationAnswer>(
          "/api/v1/configuration", Integrator, of.configuration,
          "Returns the configuration files on the disk, and the running configuration if it "
          "differs"),
      post<&ConfigurationDesk::check>(
          "/api/v1/check_configuration", Integrator, of.configuration, of.file_changes,
          "Checks the configuration with these texts in place of some files, and returns their "
          "changes"),
      post<&ConfigurationDesk::try_out>(
          "/api/v1/try_configuration", Integrator, of.configuration, of.file_changes,
          "Checks the configuration like check_configuration, and runs it on trial until it is "
          "confirmed or reverted"),
      post<&ConfigurationDesk::check_recipe>(
          "/api/v1/check_recipe", Integrator, of.configuration, of.file_changes,
          "Checks the configuration with these limits and regions in a recipe's file, which is "
          "otherwise unchanged, and returns the changes"),
      post<&ConfigurationDesk::try_recipe>(
          "/api/v1/try_recipe", Integrator, of.configuration, of.file_changes,
          "Checks the recipe like check_recipe, and runs it on trial until it is confirmed or "
          "reverted, like try_configuration"),
      post<&ConfigurationDesk::confirm>("/api/v1/confirm_configuration", Integrator,
                                        of.configuration, of.file_changes,
                                        "Confirms the configuration on trial: writes its files"),
      post<&ConfigurationDesk::revert>("/api/v1/revert_configuration", Integrator, of.configuration,
                                       of.file_changes, "Reverts the configuration on trial"),
  };
}

std::vector<Route> plant_routes(const RouteOwners& of) {
  return {
      get<&InterfaceRoutes::about>(
          "/api/v1/about", Viewer, of.interfaces,
          "Returns the versions of the programs, and the interfaces that accept commands"),
      get<&InterfaceRoutes::tables>(
          "/api/v1/interfaces", Integrator, of.interfaces,
          "Returns Modbus registers with their values, connected clients, and DDS topics with "
          "their readers"),
      get<&FleetRoutes::list>(
          "/api/v1/appliances", Viewer, of.fleet,
          "Returns all appliances of the DDS domain, including those that left: state, page, and "
          "the time since their last message"),
      get<&FleetRoutes::picture>(
          "/api/v1/appliances/picture.jpg", Viewer, of.fleet,
          "Returns a thumbnail of an appliance of the domain, updated every few seconds while the "
          "list is requested",
          kJpeg),
      post<&FleetRoutes::forget>("/api/v1/forget_appliances", Operator, of.fleet, of.file_changes,
                                 "Removes appliances that left from the list"),
  };
}

std::vector<Route> recording_routes(const RouteOwners& of) {
  return {
      get<&RecordingRoutes::list, RecordingsAnswer>(
          "/api/v1/recordings", Viewer, of.recordings,
          "Returns the recorder's newest events, or those that match, each with the cameras' "
          "pictures "
          "from before and after a trigger. The ETag changes with the answer"),
      get<&RecordingRoutes::picture>("/api/v1/recordings/trigger.jpg", Viewer, of.recordings,
                                     "Returns the picture of an event's trigger", kJpeg),
      get<&RecordingRoutes::frames, FramesAnswer>(
          "/api/v1/recordings/frames", Viewer, of.recordings,
          "Returns the times of an event's pictures by camera"),
      get<&RecordingRoutes::frame>(
          "/api/v1/recordings/frame.jpg", Viewer, of.recordings,
          "Returns one picture of an event: the recorded part; one channel of 16 bit is stretched "
          "from its darkest to its brightest pixel",
          kJpeg),
      get<&RecordingRoutes::signals, SignalsAnswer>(
          "/api/v1/recordings/signals", Viewer, of.recordings,
          "Returns the signals that an event recorded with its frame sets: measurements of regions "
          "and the machine's state"),
      get<&RecordingRoutes::signal, RecordedCourse>(
          "/api/v1/recordings/signal", Viewer, of.recordings,
          "Returns a signal over an event: lowest and highest value of each step, in the order of "
          "the recording. A step is a frame set; in events of more than 2048 it is 2, 4, 8 ... in "
          "succession"),
      get<&RecordingRoutes::regions, RegionsAnswer>(
          "/api/v1/recordings/regions", Viewer, of.recordings,
          "Returns the regions of an event's recipes in the cameras' pictures, by the "
          "configuration "
          "and the alignments that it was measured with. 409: the recording lacks them"),
      get<&RecordingRoutes::recording>(
          "/api/v1/recordings/event.mcap", Viewer, of.recordings,
          "Returns an event as an MCAP file in the definitions of ROS 2", kMcap),
      post<&RecordingRoutes::pin>("/api/v1/pin_recording", Operator, of.recordings,
                                  of.recording_changes,
                                  "Protects an event from being deleted for room, or ends that"),
      post<&RecordingRoutes::remove>("/api/v1/remove_recording", Integrator, of.recordings,
                                     of.recording_changes, "Deletes an event, also a pinned one"),
  };
}

std::vector<Route> export_routes(const RouteOwners& of) {
  return {
      post<&ExportRoutes::begin>(
          "/api/v1/export_recording", Viewer, of.exports, of.recording_changes,
          "Begins an export of an event, or of a range of it, as a file for other programs. The "
          "appliance makes one at a time, keeps it for 10 minutes, and leaves half of the disk's "
          "free space above reserve_mib"),
      get<&ExportRoutes::status>("/api/v1/recordings/export", Viewer, of.exports,
                                 "Returns state and progress of the newest export"),
      get<&ExportRoutes::file>("/api/v1/recordings/exported", Viewer, of.exports,
                               "Returns the file of a finished export, once: it is removed then",
                               kMcap),
      post<&ExportRoutes::cancel>("/api/v1/cancel_export", Viewer, of.exports, of.recording_changes,
                                  "Cancels an export, or removes its file; that of another user "
                                  "needs the role operator"),
  };
}

std::vector<Route> replay_routes(const RouteOwners& of) {
  return {
      post<&ReplayRoutes::begin>(
          "/api/v1/replay_recording", Viewer, of.replays, of.recording_changes,
          "Begins to measure an event again with a recipe, beside the process, to try a limit on "
          "what happened. The configuration and the alignments are those in the recording; what "
          "runs does not change. One replay runs at a time; the result of the newest is kept"),
      get<&ReplayRoutes::status>("/api/v1/recordings/replay", Viewer, of.replays,
                                 "Returns state and progress of the newest replay"),
      get<&ReplayRoutes::result>(
          "/api/v1/recordings/replayed", Viewer, of.replays,
          "Returns the result of the newest replay: alarms as they were raised and as the recipe "
          "raises them, and the signals that differ. Acknowledgements are not repeated"),
      get<&ReplayRoutes::signal>(
          "/api/v1/recordings/replayed_signal", Viewer, of.replays,
          "Returns a signal of a region as the newest replay computed it, in steps as "
          "/api/v1/recordings/signal"),
      post<&ReplayRoutes::cancel>(
          "/api/v1/cancel_replay", Viewer, of.replays, of.recording_changes,
          "Cancels a replay, or drops its result; that of another user needs the role operator"),
  };
}

std::vector<Route> device_routes(const RouteOwners& of) {
  return {
      post<&DeviceDesk::make_support>(
          "/api/v1/make_support_file", Administrator, of.device, of.device_changes,
          "Makes one file for technical support, without secrets: findings of orbwatch doctor, "
          "versions, log, figures, configuration. It takes up to a minute"),
      post<&DeviceDesk::make_backup>(
          "/api/v1/make_backup", Administrator, of.device, of.device_changes,
          "Makes one file of configuration, recipes, alignments, users, certificates and keys"),
      get<&DeviceDesk::download>("/api/v1/device_file", Administrator, of.device,
                                 "Returns the file that was made last, a tar archive in zstd. 404: "
                                 "none was made since the start",
                                 "application/zstd"),
      post<&DeviceDesk::upload>(
          "/api/v1/upload_backup", Administrator, of.device, of.device_changes,
          "Receives the next part of a backup to be restored. 409: it does not begin at the end of "
          "the part before, or the file is larger than a backup can be"),
      post<&DeviceDesk::check>(
          "/api/v1/check_restore", Administrator, of.device, of.device_changes,
          "Checks the uploaded backup; changes nothing. Returns what restoring it would change. "
          "409: it is damaged, its passphrase is wrong, or its configuration is not valid here"),
      post<&DeviceDesk::restore>(
          "/api/v1/restore", Administrator, of.device, of.device_changes,
          "Restores the uploaded backup: restarts with its files, all of them or, if that fails, "
          "none. 409: it is not the one with this sha256, or a configuration is on trial"),
      post<&DeviceDesk::reset>(
          "/api/v1/factory_reset", Administrator, of.device, of.device_changes,
          "Restarts with the delivered configuration, and removes all other configuration, "
          "alignments, users, certificates, keys and histories; recordings stay"),
      get<&DeviceDesk::update, UpdateAnswer>(
          "/api/v1/update", Administrator, of.device,
          "Returns the running version and slot, the result of the newest update, and the progress "
          "of an upload or installation"),
      post<&DeviceDesk::upload_update>(
          "/api/v1/upload_update", Administrator, of.device, of.device_changes,
          "Receives the next part of an update. 404: the device does not run an image. 409: it "
          "accepts no update at present, the part does not begin at the end of the part before, or "
          "there is no room"),
      post<&DeviceDesk::install_update>(
          "/api/v1/install_update", Administrator, of.device, of.device_changes,
          "Begins to check and install the uploaded update, which is deleted afterwards; "
          "/api/v1/update has the progress and the result"),
      post<&DeviceDesk::restart_device>(
          "/api/v1/restart_device", Administrator, of.device, of.device_changes,
          "Restarts the computer, which then tries the installed update. 409: none is installed"),
  };
}

/// One route for each of kCommands, and one for the states of the machine.
std::vector<Route> command_routes(const RouteOwners& of) {
  std::vector<Route> routes;
  routes.reserve(kCommands.size() + 1);
  for (const CommandInfo& info : kCommands) routes.push_back(command_route(info, of.commands));
  routes.push_back(machine_state_route(of.machine));
  return routes;
}

}  // namespace

std::vector<Route> routes_of(const RouteOwners& owners) {
  std::vector<Route> all{description_route()};
  for (auto* part : {status_routes, picture_routes, alignment_routes, access_routes,
                     configuration_routes, plant_routes, recording_routes, export_routes,
                     replay_routes, device_routes, command_routes}) {
    std::ranges::move(part(owners), std::back_inserter(all));
  }
  return all;
}

std::string manual_of_all_routes() { return http_manual(routes_of({})); }

}  // namespace orbwatch::app::web
