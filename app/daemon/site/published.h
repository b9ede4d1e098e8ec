// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "app/daemon/site/site_plan.h"
#include "app/files/resolve.h"
#include "app/model/configuration/program.h"
#include "app/model/sink/published.h"
#include "app/model/sink/recorded_texts.h"
#include "app/model/status/measured_recipe.h"

namespace orbwatch::app::daemon {

/// The views of a site as they are offered to the outside, by place in its names. Reentrant.
std::vector<PublishedView> published_views(const files::Resolved& site, const SitePlan& plan);

/// Its cameras, by place in its names. Reentrant.
std::vector<PublishedCamera> published_cameras(const files::Resolved& site);

/// The room as each of its cameras' whole picture shows it, by place in its names; null: the camera
/// is not registered. Reentrant.
std::vector<std::shared_ptr<const optics::ViewProjection>> camera_balls(
    const files::Resolved& site);

/// Its recipes, with the outlines and projections that they are measured by. Reentrant.
std::vector<MeasuredRecipe> measured_recipes(const files::Resolved& site, const SitePlan& plan);

/// All texts of its configuration by the names of their files, with versions of the program and its
/// libraries. Reentrant.
RecordedTexts recorded_texts(const files::Resolved& site, const Program& program);

}  // namespace orbwatch::app::daemon
