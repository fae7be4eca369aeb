#pragma once
// Reads the MJCF of a scene with bodies and its meshes into the configuration, so that they are part of the
// identity of a run. A mesh must be a closed surface: each edge is in two triangles, once in each direction.

#include <filesystem>
#include <functional>
#include <string>

#include "proto/config.pb.h"

namespace longreach {

/// Reads the file that bodies.mjcf_file names, using `find`, and the files in its attributes file="..." from
/// the same folder, unless they are given inline. Throws ConfigError "FILE:LINE: reason" or "FILE: reason".
void load_scene_files(proto::Bodies& bodies,
                      const std::function<std::filesystem::path(const std::string& name)>& find);

/// Wavefront OBJ with `v` and `f` lines. Throws ConfigError "NAME:LINE: reason" unless it is a closed
/// surface.
void require_closed_mesh(const std::string& name, const std::string& obj);

}  // namespace longreach
