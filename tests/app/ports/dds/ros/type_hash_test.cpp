// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/ros/type_hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <regex>
#include <string>

#include "app/ports/dds/generated/appliance.h"
#include "app/ports/dds/generated/camera_info.h"
#include "app/ports/dds/generated/command.h"
#include "app/ports/dds/generated/compressed_image.h"
#include "app/ports/dds/generated/diagnostics.h"
#include "app/ports/dds/generated/event.h"
#include "app/ports/dds/generated/image.h"
#include "app/ports/dds/generated/machine_state.h"
#include "app/ports/dds/generated/participant_entities.h"
#include "app/ports/dds/generated/process_state.h"
#include "app/ports/dds/generated/type_hashes.h"

namespace orbwatch::app::dds {
namespace {

struct Published {
  std::string_view type;
  std::string_view hash;
};

/// Hashes from ROS 2's own generator in published packages (Kilted).
constexpr std::array kPublished{
    Published{"builtin_interfaces/msg/Time",
              "b106235e25a4c5ed35098aa0a61a3ee9c9b18d197f398b0e4206cea9acf9c197"},
    Published{"std_msgs/msg/Header",
              "f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01"},
    Published{"sensor_msgs/msg/Image",
              "d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47"},
    Published{"sensor_msgs/msg/CompressedImage",
              "15640771531571185e2efc8a100baf923961a4d15d5569652e6cb6691e8e371a"},
    Published{"sensor_msgs/msg/RegionOfInterest",
              "ad16bcba5f9131dcdba6fbded19f726f5440e3c513b4fb586dd3027eeed8abb1"},
    Published{"sensor_msgs/msg/CameraInfo",
              "b3dfd68ff46c9d56c80fd3bd4ed22c7a4ddce8c8348f2f59c299e73118e7e275"},
    Published{"diagnostic_msgs/msg/KeyValue",
              "d68081eaa540288c5440753baecef0c4e16e81a5f78ad68902ded5100413bb42"},
    Published{"diagnostic_msgs/msg/DiagnosticStatus",
              "b0e3e692ea2d54a8af2f4ef1930e81556a2db55216b771f8a7d2724ed47bf0e4"},
    Published{"diagnostic_msgs/msg/DiagnosticArray",
              "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e"},
    Published{"rmw_dds_common/msg/Gid",
              "ab6f21cfbb0a6dbb837161e1110c2051a2850ed9f9c53944d7115d9bcebedf71"},
    Published{"rmw_dds_common/msg/NodeEntitiesInfo",
              "8ffef65ee2d088c63b1e8fcd31e800ba9fc8dbe0ee15ca60d1676de5218087a7"},
    Published{"rmw_dds_common/msg/ParticipantEntitiesInfo",
              "91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e"},
};

/// "sensor_msgs/msg/Image" of "sensor_msgs::msg::dds_::Image_".
std::string ros_name(std::string_view type) {
  static const std::regex kForm("(\\w+)::msg::dds_::(\\w+)_");
  return std::regex_replace(std::string(type), kForm, "$1/msg/$2");
}

TEST(TypeHash, IsTheOneThatRos2Publishes) {
  for (const Published& published : kPublished) {
    const auto found = std::ranges::find(kTypeHashes, published.type,
                                         [](const TypeHash& hash) { return ros_name(hash.type); });
    ASSERT_NE(found, kTypeHashes.end()) << published.type;
    EXPECT_EQ(found->hash, "RIHS01_" + std::string(published.hash)) << published.type;
  }
}

/// The types are final: another hash means another type, which no existing reader matches.
TEST(TypeHash, OfOurTypesNeverChanges) {
  for (const Published& ours : {
           Published{"orbwatch_msgs/msg/Appliance",
                     "579b3977ddc8aec2bb7a3250fe21518c719b3770dab5d0619498143a4d96261f"},
           Published{"orbwatch_msgs/msg/Command",
                     "0356d1102374daad29460dfab9e13c77a5549a916e1a324fe49bbbe78117cf45"},
           Published{"orbwatch_msgs/msg/CommandResult",
                     "8a6dce36214c222271138b00fd9d8e39c41608deae75fa9704c7857757c9caca"},
           Published{"orbwatch_msgs/msg/Component",
                     "acd73883205980ccabc5c131e3bd7a6bae26268eb3e9210e709bb597b8945938"},
           Published{"orbwatch_msgs/msg/Event",
                     "d5bfe84cd965434837076841564d4abd97d15fa7256c56392aea655fb891349a"},
           Published{"orbwatch_msgs/msg/Figure",
                     "05990ddf8cd3157538d46edf6988b40c524ea136c940dddc07681dc04c0fc7b2"},
           Published{"orbwatch_msgs/msg/MachineState",
                     "139a39e6c2c7044446813c1fd469138ac98995f13f192b033e18edbdab0646e2"},
           Published{"orbwatch_msgs/msg/ProcessState",
                     "21bc9d345313d44da760e364ce40241ebcc8b10fa0cc693db5af25395d9c9f8d"},
           Published{"orbwatch_msgs/msg/Thumbnail",
                     "a8e64787d0ea3d15de355983eb3f54ae90016c7bfe8fa251e63dc9b1cccaf903"},
       }) {
    const auto found = std::ranges::find(kTypeHashes, ours.type,
                                         [](const TypeHash& hash) { return ros_name(hash.type); });
    ASSERT_NE(found, kTypeHashes.end()) << ours.type;
    EXPECT_EQ(found->hash, "RIHS01_" + std::string(ours.hash)) << ours.type;
  }
}

std::string user_data(const Qos& qos) {
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos.get(), &data, &size)) return {};
  std::string text(static_cast<const char*>(data), size);
  dds_free(data);
  return text;
}

TEST(TypeHash, EveryTopicTypeAnnouncesOne) {
  const std::regex form("typehash=RIHS01_[0-9a-f]{64};");
  for (const dds_topic_descriptor_t* type :
       {&sensor_msgs_msg_dds__Image__desc, &sensor_msgs_msg_dds__CompressedImage__desc,
        &sensor_msgs_msg_dds__CameraInfo__desc, &diagnostic_msgs_msg_dds__DiagnosticArray__desc,
        &rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc,
        &orbwatch_msgs_msg_dds__ProcessState__desc, &orbwatch_msgs_msg_dds__Event__desc,
        &orbwatch_msgs_msg_dds__Command__desc, &orbwatch_msgs_msg_dds__CommandResult__desc,
        &orbwatch_msgs_msg_dds__MachineState__desc, &orbwatch_msgs_msg_dds__Appliance__desc,
        &orbwatch_msgs_msg_dds__Thumbnail__desc}) {
    const Qos qos(dds_create_qos());
    const auto announced = announce_type_hash(qos, *type);
    ASSERT_TRUE(announced) << announced.error().message;
    EXPECT_TRUE(std::regex_match(user_data(qos), form)) << type->m_typename << user_data(qos);
  }
}

TEST(TypeHash, AForeignTypeIsNotAnnounced) {
  dds_topic_descriptor_t foreign = sensor_msgs_msg_dds__Image__desc;
  foreign.m_typename = "std_msgs::msg::dds_::String_";
  const Qos qos(dds_create_qos());
  EXPECT_FALSE(announce_type_hash(qos, foreign));
  EXPECT_EQ(user_data(qos), "");
}

}  // namespace
}  // namespace orbwatch::app::dds
