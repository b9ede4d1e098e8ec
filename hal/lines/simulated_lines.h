// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal/lines/line.h"

namespace orbwatch::hal {

/// Lines of a simulated chip, labelled "simulated", that behave like the kernel's without debounce.
/// A line may be opened once as an input and once as an output: then it is a wire between the two.
/// Thread-safe; opened lines may outlive it.
class SimulatedLines : public LineBackEnd {
 public:
  /// Edges that wait for each input; beyond that the newest are dropped, as in the kernel.
  static constexpr std::size_t kQueue = 16;

  /// Called with each new level of a wire, on the thread that changed it, in order.
  using OnChange = std::function<void(const std::string& line, bool level)>;

  /// True while a line is connected. Thread-safe.
  using IsConnected = std::function<bool(const std::string& line)>;

  /// Null: changes are not reported; every line is connected.
  explicit SimulatedLines(const std::vector<std::string>& names,
                          const OnChange& on_change = nullptr,
                          const IsConnected& is_connected = nullptr);
  ~SimulatedLines() override;

  std::vector<ChipInfo> chips() const override;
  Result<std::unique_ptr<DigitalInput>> open_input(const InputSettings& settings) override;
  Result<std::unique_ptr<DigitalOutput>> open_output(const OutputSettings& settings) override;

  /// Drives a wire from outside; makes an edge if the level differs. The line must exist.
  void drive(const std::string& line, bool level, TimePoint stamp = Clock::now());

  /// Level of the wire.
  bool level(const std::string& line) const;

  /// Sets a fault from now on, until a call with None; edges are lost meanwhile.
  void fail_with(const std::string& line, LineFault fault);

 private:
  struct Wire;
  class Input;
  class Output;

  Wire& wire(const std::string& line) const;
  Result<std::shared_ptr<Wire>> find(const LineAddress& address) const;

  std::vector<std::shared_ptr<Wire>> wires_;
};

}  // namespace orbwatch::hal
