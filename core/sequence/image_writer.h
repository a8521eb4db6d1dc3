// Images to files: EXR for data, PNG for the eye.
#pragma once

#include "core/sequence/exr_writer.h"

#include <quell/abi.h>

#include <map>
#include <string>
#include <vector>

namespace quell {

struct WriteOptions {
  bool half = true;  // where half can hold the type; depth, position, tables and the like are always written as float
  ExrCompression compression;
  std::map<std::string, std::string> metadata;
};

// Channel names that a type is written with and by default read from: R G B, X Y Z, Z, Y…
std::vector<std::string> channel_names(int type, int channels);

// Throws Error(Exit::usage) where write_image would, for every image of this type.
void check_writing(const std::string& path, int type);

// Writes under a temporary name, then renames. By the path's extension: .exr (any type; ids and masks as uint32), or
// .png (8 bit; radiance and albedo encoded as sRGB, display as it is, normals from [-1,1]). Throws
// Error(Exit::resources) when the file cannot be written, and Error(Exit::usage) for another extension and a type that
// PNG cannot show.
void write_image(const std::string& path, const quell_image& image, int type, const WriteOptions& options = {});

}  // namespace quell
