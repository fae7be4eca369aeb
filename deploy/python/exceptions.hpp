#pragma once
// Translates the project's exceptions into those of longreach.errors, which include the name of the field.

namespace longreach {

/// Imports longreach.errors. Call this once, when the extension module is imported.
void register_exceptions();

}  // namespace longreach
