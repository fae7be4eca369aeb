#pragma once
// The MJCF of a scene with bodies, and the meshes that it names, read into the configuration: so a run's name
// covers them. A mesh has to be a closed surface: each edge in two triangles, once in either direction.

#include <filesystem>
#include <functional>
#include <string>

#include "proto/config.pb.h"

namespace longreach {

/// Reads what bodies.mjcf_file names, by `find`, beside it the files in its attributes file="...", if nothing
/// is given in place. Throws ConfigError "FILE:LINE: reason" or "FILE: reason".
void load_scene_files(proto::Bodies& bodies,
                      const std::function<std::filesystem::path(const std::string& name)>& find);

/// Wavefront OBJ: `v` and `f` lines. Throws ConfigError "NAME:LINE: reason" unless it is a closed surface.
void require_closed_mesh(const std::string& name, const std::string& obj);

}  // namespace longreach
