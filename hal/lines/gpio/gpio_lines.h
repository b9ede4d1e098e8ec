// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hal/lines/line.h"

namespace orbwatch::hal {

/// The kernel's lines, through libgpiod 1.6 or 2.x.
class GpioLines : public LineBackEnd {
 public:
  std::vector<ChipInfo> chips() const override;
  Result<std::unique_ptr<DigitalInput>> open_input(const InputSettings& settings) override;
  Result<std::unique_ptr<DigitalOutput>> open_output(const OutputSettings& settings) override;
};

}  // namespace orbwatch::hal
