#pragma once
// Reads the MJCF file of a scene with bodies, and its meshes, into the configuration, so that the hash of the
// configuration covers them. A mesh must be a closed surface: each edge belongs to two triangles, once in
// each direction.

#include <filesystem>
#include <functional>
#include <string>

#include "proto/config.pb.h"

namespace longreach {

/// Uses `find` to locate and read the file that bodies.mjcf_file names. Reads the files named by its
/// attributes file="..." from the same folder. Files that are given inline are not read. Throws ConfigError
/// "FILE:LINE: reason" or "FILE: reason".
void load_scene_files(proto::Bodies& bodies,
                      const std::function<std::filesystem::path(const std::string& name)>& find);

/// Checks that a Wavefront OBJ mesh with `v` and `f` lines is a closed surface. Throws ConfigError
/// "NAME:LINE: reason" if it is not.
void require_closed_mesh(const std::string& name, const std::string& obj);

}  // namespace longreach
