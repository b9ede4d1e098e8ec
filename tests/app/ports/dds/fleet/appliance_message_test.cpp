// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/fleet/appliance_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "app/pictures/jpeg_encoder.h"
#include "app/pictures/thumbnail.h"

namespace orbwatch::app::dds {
namespace {

using testing::HasSubstr;

ApplianceNotice full_notice() {
  ApplianceNotice notice{{"Zelle für Größe", "1.2.3", "site/cell3", {"10.0.0.7", 8443}}};
  notice.state = SystemState::Degraded;
  notice.condition = {Severity::Warning, "degraded: a camera"};
  notice.alarms = 3;
  notice.alarm = {Severity::Alarm, "2, weld: hot_spot_width: high alarm"};
  return notice;
}

template <std::size_t size>
void fill(char (&place)[size], const std::string& text) {
  std::memset(place, 0, size);
  text.copy(place, size - 1);
}

TEST(ApplianceMessage, ArrivesAsItWasMade) {
  const auto notice = check_appliance(appliance_message(full_notice()));
  ASSERT_TRUE(notice) << notice.error().message;
  const ApplianceNotice sent = full_notice();
  EXPECT_EQ(notice->name, sent.name);
  EXPECT_EQ(notice->version, sent.version);
  EXPECT_EQ(notice->prefix, sent.prefix);
  EXPECT_EQ(url_of(notice->page), "https://10.0.0.7:8443/");
  EXPECT_EQ(notice->state, sent.state);
  EXPECT_EQ(notice->condition.severity, sent.condition.severity);
  EXPECT_EQ(notice->condition.text, sent.condition.text);
  EXPECT_EQ(notice->alarms, sent.alarms);
  EXPECT_EQ(notice->alarm.severity, sent.alarm.severity);
  EXPECT_EQ(notice->alarm.text, sent.alarm.text);
}

TEST(ApplianceMessage, HasTextsThatFitCutBetweenCharacters) {
  ApplianceNotice notice = full_notice();
  notice.name.assign(63, 'a').append("ü");
  notice.alarm.text.assign(1000, 'x');
  const auto arrived = check_appliance(appliance_message(notice));
  ASSERT_TRUE(arrived) << arrived.error().message;
  EXPECT_EQ(arrived->name, std::string(63, 'a'));
  EXPECT_EQ(arrived->alarm.text, std::string(255, 'x'));
}

TEST(ApplianceMessage, OfAStrangerIsMadeSafeToShow) {
  ApplianceMessage message = appliance_message(full_notice());
  fill(message.name, "\x1b[31m\xff<script>");
  fill(message.condition, "a\nb");
  std::memset(message.alarm, 'x', sizeof message.alarm);  // no terminating zero
  const auto notice = check_appliance(message);
  ASSERT_TRUE(notice) << notice.error().message;
  EXPECT_EQ(notice->name, "?[31m?<script>");
  EXPECT_EQ(notice->condition.text, "a?b");
  EXPECT_EQ(notice->alarm.text, std::string(255, 'x'));
}

TEST(ApplianceMessage, LeadsToNumericAddressesOnly) {
  for (const char* address : {"evil.example", "javascript:alert(1)", "0.0.0.0", "10.0.0.7/"}) {
    ApplianceMessage message = appliance_message(full_notice());
    fill(message.page_address, address);
    EXPECT_EQ(check_appliance(message)->page.address, "") << address;
  }
  ApplianceMessage message = appliance_message(full_notice());
  message.page_port = 0;
  EXPECT_EQ(check_appliance(message)->page.address, "");
}

TEST(ApplianceMessage, WithACodeThatDoesNotExistIsRefused) {
  const auto refusal = [](std::uint8_t ApplianceMessage::*code) {
    ApplianceMessage message = appliance_message(full_notice());
    message.*code = 200;
    const auto notice = check_appliance(message);
    return notice ? "" : notice.error().message;
  };
  EXPECT_THAT(refusal(&ApplianceMessage::system_state), HasSubstr("system state 200 is unknown"));
  EXPECT_THAT(refusal(&ApplianceMessage::severity), HasSubstr("severity 200 is unknown"));
  EXPECT_THAT(refusal(&ApplianceMessage::alarm_severity), HasSubstr("severity 200 is unknown"));
}

std::vector<std::uint8_t> grey_jpeg(int width, int height) {
  const std::vector<std::byte> pixels(static_cast<std::size_t>(width) * height, std::byte{90});
  JpegEncoder encoder;
  const auto jpeg = encoder.encode(
      Picture::contiguous(PixelFormat::Grey, width, height, pixels.data(), width), 80);
  return {jpeg->begin(), jpeg->end()};
}

Result<> check(std::vector<std::uint8_t> jpeg) {
  const auto length = static_cast<std::uint32_t>(jpeg.size());
  return check_thumbnail({{length, length, jpeg.data(), false}});
}

TEST(ThumbnailMessage, IsASmallJpegThatIsWhole) {
  EXPECT_TRUE(check(grey_jpeg(Thumbnail::kLongestSide, Thumbnail::kLongestSide)));
  EXPECT_TRUE(check(grey_jpeg(1, 1)));
  EXPECT_FALSE(check({}));
  EXPECT_FALSE(check({'<', 's', 'v', 'g', '>'}));
  const auto large = check(grey_jpeg(Thumbnail::kLongestSide + 1, 8));
  ASSERT_FALSE(large);
  EXPECT_THAT(large.error().message, HasSubstr("161 x 8 pixels"));
  auto cut = grey_jpeg(64, 64);
  cut.resize(cut.size() / 2);
  EXPECT_FALSE(check(cut));
}

}  // namespace
}  // namespace orbwatch::app::dds
