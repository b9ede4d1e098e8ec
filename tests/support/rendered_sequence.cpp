// SPDX-License-Identifier: Apache-2.0
#include "tests/support/rendered_sequence.h"

#include <opencv2/core.hpp>

#include "proc/optics/lens.h"
#include "tests/support/rendered_scene.h"

namespace orbwatch::tests {
namespace {

optics::Box box(const cv::FileNode& n) { return {scene_vector(n["lo"]), scene_vector(n["hi"])}; }

optics::CalibratedCamera calibrated(const cv::FileNode& n) {
  const cv::FileNode rotation = n["R_wc"];
  // The file's pixels have their centres at +0.5, the product's at integers.
  const optics::Intrinsics intrinsics{static_cast<int>(n["width"]), static_cast<int>(n["height"]),
                                      scene_number(n["fx"]),        scene_number(n["fy"]),
                                      scene_number(n["cx"]) - 0.5,  scene_number(n["cy"]) - 0.5,
                                      optics::Distortion::None,     {}};
  return {optics::Lens::make(intrinsics).value(),
          {{scene_vector(rotation[0]), scene_vector(rotation[1]), scene_vector(rotation[2])},
           scene_vector(n["C"])},
          std::nullopt};
}

}  // namespace

RenderedSequence::RenderedSequence(const std::string& name) {
  const cv::FileStorage file = open_rendered_scene();
  const cv::FileNode sequence = file["sequences"][name];
  frame_rate_ = scene_number(sequence["fps"]);
  scene_.ball = {scene_vector(file["ball"]["centre"]), scene_number(file["ball"]["radius"])};
  optics::Scene scene;
  scene.room = optics::Scene::Room::Box;
  scene.walls = box(file["box"]);
  // The workpiece with the pool is in the pictures but not in the file.
  scene.obstacles = {box(file["table"]), {{-190, -130, 140}, {-30, 30, 178}}};
  scene_.proxy = optics::SceneProxy::make(scene, scene_.ball).value();
  camera_.push_back(optics::BallProjection::make(optics::BallModel::Kind::Exact,
                                                 calibrated(sequence["camera"]), scene_.ball,
                                                 scene_.proxy)
                        .value());
  for (const auto& n : sequence["frames"]) {
    Frame frame{
        rendered_pictures() / static_cast<std::string>(n["file"]), scene_vector(n["melt"]), {}};
    for (const auto& spark : n["sparks"]) {
      frame.sparks.push_back({static_cast<int>(spark["id"]), scene_vector(spark["xyz"]),
                              scene_number(spark["r"]), scene_number(spark["tc"])});
    }
    frames_.push_back(std::move(frame));
  }
}

}  // namespace orbwatch::tests
