// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/fleet/appliance_message.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "app/model/plain_text.h"
#include "app/pictures/thumbnail.h"
#include "hal/jpeg/jpeg_decoder.h"

namespace orbwatch::app::dds {
namespace {

static_assert(sizeof(ApplianceMessage::name) == ApplianceIdentity::kLongestName + 1);

template <std::size_t size>
void copy(const std::string& text, char (&place)[size]) {
  plain_text(text, size - 1).copy(place, size - 1);  // the rest stays zero
}

template <std::size_t size>
std::string text_of(const char (&place)[size]) {
  return plain_text({place, ::strnlen(place, size)}, size - 1);
}

Result<Severity> checked_severity(std::uint8_t number) {
  const auto severity = static_cast<Severity>(number);
  if (!operator_text(severity).empty()) return severity;
  return fail("appliance: severity " + std::to_string(number) + " is unknown");
}

}  // namespace

ApplianceMessage appliance_message(const ApplianceNotice& notice) {
  ApplianceMessage message{};
  copy(notice.name, message.name);
  copy(notice.version, message.version);
  copy(notice.prefix, message.prefix);
  copy(notice.page.address, message.page_address);
  message.page_port = notice.page.port;
  message.system_state = static_cast<std::uint8_t>(notice.state);
  message.severity = static_cast<std::uint8_t>(notice.condition.severity);
  copy(notice.condition.text, message.condition);
  message.alarms = notice.alarms;
  message.alarm_severity = static_cast<std::uint8_t>(notice.alarm.severity);
  copy(notice.alarm.text, message.alarm);
  return message;
}

Result<ApplianceNotice> check_appliance(const ApplianceMessage& message) {
  const auto state = static_cast<SystemState>(message.system_state);
  if (operator_text(state).empty()) {
    return fail("appliance: system state " + std::to_string(message.system_state) + " is unknown");
  }
  const auto condition = checked_severity(message.severity);
  if (!condition) return tl::unexpected(condition.error());
  const auto alarm = checked_severity(message.alarm_severity);
  if (!alarm) return tl::unexpected(alarm.error());
  ApplianceNotice notice;
  notice.name = text_of(message.name);
  notice.version = text_of(message.version);
  notice.prefix = text_of(message.prefix);
  notice.page = {text_of(message.page_address), message.page_port};
  if (url_of(notice.page).empty()) notice.page = {};
  notice.state = state;
  notice.condition = {*condition, text_of(message.condition)};
  notice.alarms = message.alarms;
  notice.alarm = {*alarm, text_of(message.alarm)};
  return notice;
}

Result<> check_thumbnail(const ThumbnailMessage& message) {
  const std::span<const std::uint8_t> jpeg(message.jpeg._buffer, message.jpeg._length);
  hal::JpegDecoder decoder;
  return decoder.read_size(std::as_bytes(jpeg))
      .and_then([&](const hal::JpegSize& size) -> Result<> {
        if (std::max(size.width, size.height) > Thumbnail::kLongestSide) {
          return fail("thumbnail: " + std::to_string(size.width) + " x " +
                      std::to_string(size.height) + " pixels, each side must be at most " +
                      std::to_string(Thumbnail::kLongestSide));
        }
        return decoder.check(std::as_bytes(jpeg));
      });
}

}  // namespace orbwatch::app::dds
