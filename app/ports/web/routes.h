// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/ports/web/api/route.h"

namespace orbwatch::app::web {

class AccessDesk;
class AlignRoutes;
class Changes;
class CommandDesk;
class ConfigurationDesk;
class DeviceDesk;
class ExportRoutes;
class FleetRoutes;
class HistoryRoutes;
class InterfaceRoutes;
class LogRoutes;
class LookAround;
class MachineDesk;
class PixelRoute;
class RecipeRoutes;
class RecordingRoutes;
class ReplayRoutes;
class StatusRoutes;
class StreamRoutes;
class ViewList;

/// Owners of the handlers. They outlive the routes; null: its routes are only described.
struct RouteOwners {
  StatusRoutes* status = nullptr;
  StreamRoutes* streams = nullptr;
  ViewList* views = nullptr;
  PixelRoute* pixels = nullptr;
  AccessDesk* access = nullptr;
  Changes* access_changes = nullptr;  ///< thread of logins and changes of users
  LookAround* look_around = nullptr;
  ConfigurationDesk* configuration = nullptr;
  Changes* file_changes = nullptr;  ///< thread of the configuration's files
  LogRoutes* log = nullptr;
  AlignRoutes* alignment = nullptr;
  RecipeRoutes* recipe = nullptr;
  HistoryRoutes* history = nullptr;
  InterfaceRoutes* interfaces = nullptr;
  FleetRoutes* fleet = nullptr;
  CommandDesk* commands = nullptr;
  const MachineDesk* machine = nullptr;
  RecordingRoutes* recordings = nullptr;
  Changes* recording_changes = nullptr;  ///< thread of the recorder's files
  ExportRoutes* exports = nullptr;
  ReplayRoutes* replays = nullptr;
  DeviceDesk* device = nullptr;
  Changes* device_changes = nullptr;  ///< thread of support file, backup and restore
};

/// The whole HTTP interface without the page's files: a line for each route, and one for all
/// commands.
std::vector<Route> routes_of(const RouteOwners& owners);

}  // namespace orbwatch::app::web
