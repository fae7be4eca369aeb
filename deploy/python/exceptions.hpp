#pragma once
// Translation of the project's exceptions to those of longreach.errors, which carry the field.

namespace longreach {

/// Imports longreach.errors. Call it once, when the extension module is imported.
void register_exceptions();

}  // namespace longreach
