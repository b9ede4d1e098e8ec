// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "proc/image/result.h"
#include "proc/signals/alarm.h"
#include "proc/signals/signals.h"

namespace orbwatch::app {

/// The raised alarm that was a trigger, in parts, from which other languages make a text.
struct AlarmCause {
  std::string region, signal;  ///< their names
  signals::AlarmLevel level = signals::AlarmLevel::None;
  double value = signals::kNotValid;
  std::string unit;
};

/// An event on the disk: pictures of the cameras from before and after a trigger.
struct RecordedEvent {
  std::string name;                    ///< unique, for requests
  std::string trigger;                 ///< name of the trigger's kind
  std::string text;                    ///< cause for operators, one line
  std::optional<AlarmCause> alarm;     ///< empty: another cause, or an earlier version's event
  std::string line;                    ///< name of the digital line; empty: likewise
  std::string first, triggered, last;  ///< UTC of frame sets; empty: not known
  std::string part;                    ///< empty: not known
  double layer = signals::kNotValid;   ///< of the part
  std::uint64_t pictures = 0;          ///< of all cameras
  std::uint64_t lost = 0;              ///< pictures that found no room
  std::uint64_t bytes = 0;             ///< while it is being recorded, less than it has
  bool is_pinned = false;              ///< it is not deleted for room
  bool is_finished = true;      ///< false: it is being recorded, or the power failed meanwhile
  bool has_beginning = true;    ///< false: pictures before the trigger are missing
  bool is_interrupted = false;  ///< it was not recorded to its end
};

/// Part of a camera's picture that is recorded, px.
struct FramePart {
  std::size_t first = 0;  ///< number of the first picture with it; the next part has the next ones
  int x = 0, y = 0, width = 0, height = 0;
};

/// Pictures of one camera in an event.
struct RecordedFrames {
  std::string camera;
  std::vector<std::string> times;  ///< UTC of their frame sets, ascending
  std::vector<FramePart> parts;
};

/// A recipe that an event was measured by, until the next one.
struct RecordedRecipeChange {
  std::string time;  ///< UTC of the first frame set
  std::uint16_t recipe = 0;
};

/// A value that an event has with its frame sets.
struct RecordedSignal {
  std::string region;  ///< empty: of the machine
  std::string figure, unit;
};

/// A signal over an event, in steps of one frame set or, in long events, of several in succession.
struct RecordedCourse {
  std::string unit;
  std::vector<std::string> times;         ///< UTC of the first frame set of each step
  std::vector<std::uint64_t> frame_sets;  ///< its number
  std::vector<double> low, high;          ///< of each step; NaN: not valid
};

/// The events of the recorder, for other interfaces. Each call waits for the disk. Thread-safe.
class RecordedEvents {
 public:
  virtual ~RecordedEvents() = default;
  /// The oldest first; the same object as long as nothing has changed. Error: the folder cannot be
  /// read.
  virtual Result<std::shared_ptr<const std::vector<RecordedEvent>>> list() = 0;

  // Errors: no such event, or the disk.

  /// The recording, an MCAP file.
  virtual Result<std::filesystem::path> recording(std::string_view event) const = 0;
  /// The picture of the trigger, a JPEG file.
  virtual Result<std::filesystem::path> picture(std::string_view event) const = 0;
  virtual Result<std::vector<RecordedFrames>> frames(std::string_view event) = 0;
  /// A picture of a camera as JPEG; 16 bit is stretched. Error also: there is no such picture.
  virtual Result<std::string> frame(std::string_view event, std::string_view camera,
                                    std::size_t frame) = 0;
  /// Signals of regions and of the machine that were a number at any time.
  virtual Result<std::vector<RecordedSignal>> signals(std::string_view event) = 0;
  /// Recipes in the order of the recording; of very many changes the first ones.
  virtual Result<std::vector<RecordedRecipeChange>> recipes(std::string_view event) = 0;
  /// Error also: there is no such signal.
  virtual Result<RecordedCourse> course(std::string_view event, const std::string& region,
                                        const std::string& figure) = 0;
  virtual Result<> set_pinned(std::string_view event, bool is_pinned) = 0;
  virtual Result<> remove(std::string_view event) = 0;
};

}  // namespace orbwatch::app
