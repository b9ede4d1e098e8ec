// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace orbwatch::hal {

/// Source of a back-end's cameras.
enum class CameraOrigin : std::uint8_t {
  Process,  ///< made by the process itself
  Files,    ///< recordings
  Kernel,   ///< V4L2 devices
  Module,   ///< devices of a library, through a module of the package orbwatch-camera-NAME
};

/// Facts that programs need to list, check and set up the cameras of a back-end. Its settings
/// struct states them as kFacts, and besides
/// - kName, its word in the site file;
/// - address() and at(ADDRESS), the settings' address and settings of a camera, if it has a key;
/// - accepts(CameraEntry), true for a listed camera that the address names, of a module;
/// - stated_format(), the format of its frames as far as the settings state it.
/// A member that is missing does not compile.
struct BackEndFacts {
  CameraOrigin origin = CameraOrigin::Process;
  std::string_view address_key{};  ///< in the site file; empty: cameras have no address
  bool needs_size = false;         ///< width and height must be stated
  bool takes_size_of_rig =
      false;  ///< a size that is not stated is the rig's: cameras offer several
  bool has_board_sensors = false;  ///< they need DMA heaps and the board's drivers
  bool shares_usb = false;         ///< its USB cameras are V4L2 devices, too, with more controls
  std::string_view radiometric_advice{};  ///< for a camera that delivers no y16
};

}  // namespace orbwatch::hal
