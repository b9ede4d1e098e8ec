#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/back_end.h"
#include "hal/camera.h"
#include "hal/fault.h"
#include "proc/image/pixel_format.h"
#include "proc/settings/settings.h"

namespace orbwatch::hal {

/// A camera whose pictures cost nothing; without a device (GenICam TestPattern).
struct TestPatternSettings {
  static constexpr std::string_view kName = "test_pattern";
  static constexpr BackEndFacts kFacts{.origin = CameraOrigin::Process, .needs_size = true};

  std::string name;  ///< becomes CameraInfo::id
  PixelFormat pixel_format = PixelFormat::Grey;
  int width = 0;          ///< unless configure() asks for another size
  int height = 0;         ///< the same
  double frame_rate = 0;  ///< per second; 0: kTestPatternRate
  bool numbered = false;  ///< see paint_number()
  std::vector<ScriptedFault> faults = {};

  std::optional<PixelFormat> stated_format() const { return pixel_format; }
};

inline constexpr double kTestPatternRate = 30;

/// Every format by its name.
inline constexpr auto kPixelFormatWords = [] {
  std::array<Word<PixelFormat>, kPixelFormats.size()> words{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = {kPixelFormats[i].name, kPixelFormats[i].format};
  }
  return words;
}();

/// All but what the context of a camera states.
template <class Visitor>
void visit(Visitor& v, TestPatternSettings& settings) {
  v.required("pixel_format", settings.pixel_format, kPixelFormatWords, "Of its frames");
  v.optional("numbered", settings.numbered,
             "Paint each frame's number into it, to tell which of them is seen");
}

std::unique_ptr<Camera> make_camera(TestPatternSettings settings, const CameraContext& context);

}  // namespace orbwatch::hal
