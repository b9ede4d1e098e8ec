// SPDX-License-Identifier: Apache-2.0
// libgpiod 2.x, the kernel's line interface v2.
#include <gpiod.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "hal/lines/gpio/gpiod_calls.h"

namespace orbwatch::hal::gpiod_calls {
namespace {

template <auto release>
struct Release {
  template <class T>
  void operator()(T* object) const {
    release(object);
  }
};
using Chip = std::unique_ptr<gpiod_chip, Release<gpiod_chip_close>>;
using LineSettings = std::unique_ptr<gpiod_line_settings, Release<gpiod_line_settings_free>>;
using Request = std::unique_ptr<gpiod_line_request, Release<gpiod_line_request_release>>;
using EdgeBuffer = std::unique_ptr<gpiod_edge_event_buffer, Release<gpiod_edge_event_buffer_free>>;

constexpr std::size_t kEdgesAtOnce = 16;

std::string text_of(const char* text) { return text ? text : ""; }

gpiod_line_bias bias_of(LineBias bias) {
  switch (bias) {
    case LineBias::AsIs:
      return GPIOD_LINE_BIAS_AS_IS;
    case LineBias::Disabled:
      return GPIOD_LINE_BIAS_DISABLED;
    case LineBias::PullUp:
      return GPIOD_LINE_BIAS_PULL_UP;
    case LineBias::PullDown:
      return GPIOD_LINE_BIAS_PULL_DOWN;
  }
  return GPIOD_LINE_BIAS_AS_IS;
}

/// Requests one line, which has a file of its own; the chip's file may be closed.
tl::expected<Request, int> request_line(const std::string& path, unsigned offset,
                                        gpiod_line_settings* settings) {
  const Chip chip(gpiod_chip_open(path.c_str()));
  if (!chip) return tl::unexpected(errno);
  const std::unique_ptr<gpiod_line_config, Release<gpiod_line_config_free>> lines(
      gpiod_line_config_new());
  const std::unique_ptr<gpiod_request_config, Release<gpiod_request_config_free>> config(
      gpiod_request_config_new());
  if (!lines || !config) return tl::unexpected(ENOMEM);
  if (gpiod_line_config_add_line_settings(lines.get(), &offset, 1, settings) != 0) {
    return tl::unexpected(errno);
  }
  gpiod_request_config_set_consumer(config.get(), kLineConsumer);
  Request request(gpiod_chip_request_lines(chip.get(), config.get(), lines.get()));
  if (!request) return tl::unexpected(errno);
  return request;
}

class Input : public DigitalInput {
 public:
  Input(Request request, EdgeBuffer buffer, unsigned offset, const InputSettings& settings)
      : request_(std::move(request)),
        buffer_(std::move(buffer)),
        offset_(offset),
        debounce_(settings.debounce),
        text_(settings.address.text()) {}

  int descriptor() const override { return gpiod_line_request_get_fd(request_.get()); }

  LineResult<std::size_t> take(std::span<EdgeEvent> edges) override {
    const std::size_t most = std::min(kEdgesAtOnce, edges.size());
    const int count = gpiod_line_request_read_edge_events(request_.get(), buffer_.get(), most);
    if (count < 0 && errno == EAGAIN) return 0;
    if (count < 0) return tl::unexpected(line_fault(text_, errno));
    for (int i = 0; i < count; ++i) {
      const auto index = static_cast<std::size_t>(i);
      edges[index] = edge_of(gpiod_edge_event_buffer_get_event(buffer_.get(), index));
    }
    return static_cast<std::size_t>(count);
  }

  LineResult<bool> level() const override {
    const int value = gpiod_line_request_get_value(request_.get(), offset_);
    if (value == GPIOD_LINE_VALUE_ERROR) return tl::unexpected(line_fault(text_, errno));
    return value == GPIOD_LINE_VALUE_ACTIVE;
  }

  bool is_debounced() const override { return true; }

 private:
  /// The kernel numbers edges from 1, drops the oldest of a full queue, and stamps a debounced one
  /// at the end of the debounce period.
  EdgeEvent edge_of(gpiod_edge_event* event) {
    const auto number = static_cast<std::uint32_t>(gpiod_edge_event_get_line_seqno(event));
    const std::uint32_t lost = number - std::exchange(last_number_, number) - 1;
    const std::chrono::nanoseconds age(gpiod_edge_event_get_timestamp_ns(event));
    const bool rising = gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE;
    return {edge_to(rising), TimePoint(age) - debounce_, lost};
  }

  Request request_;
  EdgeBuffer buffer_;
  unsigned offset_;
  Clock::duration debounce_;
  std::string text_;
  std::uint32_t last_number_ = 0;  ///< wraps like the kernel's number
};

class Output : public DigitalOutput {
 public:
  Output(Request request, unsigned offset, std::string text)
      : request_(std::move(request)), offset_(offset), text_(std::move(text)) {}
  // This fails when the chip is gone; nothing is left to do then.
  ~Output() override {
    static_cast<void>(
        gpiod_line_request_set_value(request_.get(), offset_, GPIOD_LINE_VALUE_INACTIVE));
  }

  LineResult<> set(bool active) override {
    const auto value = active ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
    if (gpiod_line_request_set_value(request_.get(), offset_, value) == 0) return {};
    return tl::unexpected(line_fault(text_, errno));
  }

 private:
  Request request_;
  unsigned offset_;
  std::string text_;
};

/// One line's settings, checked by libgpiod.
tl::expected<LineSettings, int> line_settings(gpiod_line_direction direction, bool active_low,
                                              LineBias bias) {
  LineSettings settings(gpiod_line_settings_new());
  if (!settings) return tl::unexpected(ENOMEM);
  if (gpiod_line_settings_set_direction(settings.get(), direction) != 0 ||
      gpiod_line_settings_set_bias(settings.get(), bias_of(bias)) != 0) {
    return tl::unexpected(errno);
  }
  gpiod_line_settings_set_active_low(settings.get(), active_low);
  return settings;
}

}  // namespace

tl::expected<ChipInfo, int> read_chip(const std::string& path) {
  const Chip chip(gpiod_chip_open(path.c_str()));
  if (!chip) return tl::unexpected(errno);
  const std::unique_ptr<gpiod_chip_info, Release<gpiod_chip_info_free>> about(
      gpiod_chip_get_info(chip.get()));
  if (!about) return tl::unexpected(errno);
  ChipInfo info{.path = path, .label = text_of(gpiod_chip_info_get_label(about.get()))};
  for (unsigned offset = 0; offset < gpiod_chip_info_get_num_lines(about.get()); ++offset) {
    const std::unique_ptr<gpiod_line_info, Release<gpiod_line_info_free>> line(
        gpiod_chip_get_line_info(chip.get(), offset));
    if (!line) return tl::unexpected(errno);
    info.lines.push_back({offset, text_of(gpiod_line_info_get_name(line.get())),
                          gpiod_line_info_get_direction(line.get()) == GPIOD_LINE_DIRECTION_OUTPUT,
                          gpiod_line_info_is_used(line.get()),
                          text_of(gpiod_line_info_get_consumer(line.get()))});
  }
  return info;
}

tl::expected<std::unique_ptr<DigitalInput>, int> request_input(const std::string& path,
                                                               unsigned offset,
                                                               const InputSettings& settings) {
  const auto line = line_settings(GPIOD_LINE_DIRECTION_INPUT, settings.active_low, settings.bias);
  if (!line) return tl::unexpected(line.error());
  const auto period = std::chrono::ceil<std::chrono::microseconds>(settings.debounce);
  gpiod_line_settings_set_debounce_period_us(line->get(),
                                             static_cast<unsigned long>(period.count()));
  if (gpiod_line_settings_set_edge_detection(line->get(), GPIOD_LINE_EDGE_BOTH) != 0) {
    return tl::unexpected(errno);
  }
  auto request = request_line(path, offset, line->get());
  if (!request) return tl::unexpected(request.error());
  EdgeBuffer buffer(gpiod_edge_event_buffer_new(kEdgesAtOnce));
  if (!buffer) return tl::unexpected(ENOMEM);
  if (!never_wait(gpiod_line_request_get_fd(request->get()))) return tl::unexpected(errno);
  return std::make_unique<Input>(std::move(*request), std::move(buffer), offset, settings);
}

tl::expected<std::unique_ptr<DigitalOutput>, int> request_output(const std::string& path,
                                                                 unsigned offset,
                                                                 const OutputSettings& settings) {
  const auto line = line_settings(GPIOD_LINE_DIRECTION_OUTPUT, settings.active_low, settings.bias);
  if (!line) return tl::unexpected(line.error());
  auto request = request_line(path, offset, line->get());
  if (!request) return tl::unexpected(request.error());
  return std::make_unique<Output>(std::move(*request), offset, settings.address.text());
}

}  // namespace orbwatch::hal::gpiod_calls
