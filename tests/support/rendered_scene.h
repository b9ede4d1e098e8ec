// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core/persistence.hpp>
#include <string>
#include <vector>

#include "proc/optics/vec.h"

namespace orbwatch::tests {

/// The rendered reference pictures beside the project, and the file that describes how they were
/// made.
std::filesystem::path rendered_pictures();

/// Their scene.json, with empty strings for null.
cv::FileStorage open_rendered_scene();

/// Numbers in that file.
inline double scene_number(const cv::FileNode& node) { return static_cast<double>(node); }
inline optics::Vec3 scene_vector(const cv::FileNode& n) {
  return {scene_number(n[0]), scene_number(n[1]), scene_number(n[2])};
}

/// A view whose truth is among the reference pictures.
struct RenderedView {
  double yaw, pitch, roll, h_fov;
  int width, height;
  int thermal_width, thermal_height;  ///< 0: this view has no thermal truth
};

struct RenderedCamera {
  std::string name;
  std::filesystem::path picture;
};

/// The content of scene.json in the product's formats. Its pixels have their centres at +0.5, the
/// product's at integers.
class RenderedScene {
 public:
  /// Part of the machine's geometry that a rig states.
  enum class Known { Nothing, BoxAndTable };

  /// `name`: far, near, near50. Throws when the file is missing or broken.
  explicit RenderedScene(const std::string& name);

  const std::vector<RenderedCamera>& cameras() const { return cameras_; }
  const std::vector<RenderedView>& views() const { return views_; }

  /// A rig file of calibrated cameras.
  std::string rig(Known known) const;

  /// A rig file of cameras with the paper's calibration: outline, alpha and a rotation.
  std::string uncalibrated_rig() const;

 private:
  std::string ball_;
  std::string scene_;
  std::vector<std::string> calibrated_;
  std::vector<std::string> uncalibrated_;
  std::vector<RenderedCamera> cameras_;
  std::vector<RenderedView> views_;
};

}  // namespace orbwatch::tests
