#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/certificates/dates.h"
#include "app/files/resolve.h"
#include "app/model/measured_recipe.h"
#include "app/pipeline/pipeline.h"
#include "hal/camera.h"

namespace orbwatch::app {

/// What a camera will deliver as far as the files state it; limits in percent fit any depth.
hal::StreamFormat expected_format(const Resolved& site, std::size_t camera);

/// Makes the pipeline's plan of a site, all but cameras, triggers and process inputs: the one place
/// where settings become objects. Compiles every recipe, so that each can be selected within a
/// frame. `formats`: by camera. Errors: what keeps files from running together although each is
/// right by itself; they name view, region or recipe.
Result<PipelinePlan> build(const Resolved& site, std::vector<hal::StreamFormat> formats);

/// Makes those parts of the plan anew that use `camera`, which came with another format than was
/// expected. Errors: as build().
Result<Recompiled> rebuild(const Resolved& site, std::vector<hal::StreamFormat> formats,
                           std::size_t camera);

/// What the recipes measure, with the outlines and projections that build() measures by. Errors: as
/// build().
Result<std::vector<MeasuredRecipe>> measured_recipes(const Resolved& site);

/// Decisions of build() where rig and recipes state nothing, in words that name the file: cameras
/// that are left out, and limits of hot spots, by region and key, for the formats that are
/// expected. Empty: all is stated, or the site has an error.
std::vector<std::string> assumptions(const Resolved& site);

/// Error: Modbus and the page would listen on one port.
Result<> check_ports(const Resolved& site);

/// Checks the keys for DDS, and certificate and key of the page, as far as files are named.
Result<> check_keys(const Resolved& site, Dates dates);

/// Checks what build() would refuse with the formats that are expected, and the keys. Opens no
/// camera and no line; compiles no view and allocates no picture, so that it may run beside the
/// site.
Result<> check_site(const Resolved& site, Dates dates);

}  // namespace orbwatch::app
