// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/tags/tag_finder.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "proc/align/detect/picture/luminance.h"
#include "proc/align/place/tags/mirror_view.h"
#include "proc/align/place/tags/tag_detector.h"

namespace orbwatch::align {
namespace {

cv::Mat eight_bit(const cv::Mat& luminance) {
  if (luminance.depth() == CV_8U) return luminance;
  cv::Mat out;
  cv::normalize(luminance, out, 0, 255, cv::NORM_MINMAX, CV_8U);
  return out;
}

/// A tag in a view; the nearer to the view's middle, the less it is distorted.
struct Seen {
  FoundTag tag;
  double off_middle;
};

/// The tag in the ball's picture; nullopt if a corner is beyond the view or the ball.
std::optional<Seen> seen(const TagInView& in_view, const optics::BallProjection& ball,
                         const optics::ViewProjection& view) {
  Seen out{{in_view.id, {}}, 0};
  cv::Point2d middle;
  for (std::size_t k = 0; k < 4; ++k) {
    const cv::Point2d corner = in_view.corners[k];
    const auto direction = view.direction(corner.x, corner.y);
    const auto pixel = direction ? ball.pixel(*direction, 0) : std::nullopt;
    if (!pixel) return std::nullopt;
    out.tag.corners[k] = *pixel;
    middle += corner / 4;
  }
  out.off_middle = std::hypot(middle.x - view.width() / 2.0, middle.y - view.height() / 2.0);
  return out;
}

/// Side of a view with about one and a half times the picture's best resolution: half the limb's
/// radius per rad.
int view_side(const optics::Outline& outline) {
  constexpr double kSides = 1.8;  // side of a view of 100 degrees, per radius
  constexpr int kLeast = 300, kMost = 1600;
  return std::clamp(int(kSides * (outline.rx + outline.ry) / 2), kLeast, kMost);
}

}  // namespace

Result<std::vector<FoundTag>> find_tags(const Picture& picture, const optics::Outline& outline,
                                        const std::optional<optics::Lens>& lens,
                                        const WorkProgress& progress) {
  if (auto ellipse = optics::check_ellipse(outline); !ellipse) {
    return tl::unexpected(ellipse.error());
  }
  if (lens &&
      (lens->intrinsics().width != picture.width || lens->intrinsics().height != picture.height)) {
    return fail("the picture is not of the size for which the lens is calibrated");
  }
  const auto ball = unplaced_projection(outline, lens);
  if (!ball) return tl::unexpected(ball.error());
  const cv::Mat luminance = eight_bit(luminance_of(picture));
  TagDetector detector;
  std::map<int, Seen> found;
  const std::vector<optics::ViewProjection> views = views_all_around(view_side(outline));
  for (std::size_t n = 0; n < views.size(); ++n) {
    const double share = static_cast<double>(n) / static_cast<double>(views.size());
    if (auto wanted = progress.at(WorkStep::Tags, share); !wanted) {
      return tl::unexpected(wanted.error());
    }
    const optics::ViewProjection& view = views[n];
    for (const TagInView& in_view : detector.detect(mirror_view(luminance, *ball, view))) {
      const auto tag = seen(in_view, *ball, view);
      if (!tag) continue;
      const auto [known, is_new] = found.try_emplace(in_view.id, *tag);
      if (!is_new && tag->off_middle < known->second.off_middle) known->second = *tag;
    }
  }
  std::vector<FoundTag> tags;
  tags.reserve(found.size());
  for (const auto& [id, one] : found) tags.push_back(one.tag);
  return tags;
}

}  // namespace orbwatch::align
