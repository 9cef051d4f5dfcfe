#pragma once

#include <string>

#include "json.hpp"

namespace lekalo::verify {

/// Complains of a member of a placement, or of its certificate's file, that is given twice or that no
/// placement has: it may be a claim of whoever wrote it, and nobody would have rechecked it. What stands in
/// the nodes of certificates is left to their reader. Cost: O(bytes).
void refuse_unknown_fields(Json placement, std::string& complaint);

/// The same for a placement of solids, or its certificate's file.
void refuse_unknown_fields_of_solids(Json placement, std::string& complaint);

/// The same for a value that stands in other reports too: `key` is "regions", "drawing" or "scan".
void refuse_unknown_fields(Json value, const std::string& key, std::string& complaint);

/// The same for a file of a region: a word that is misspelt may have been meant to say something of its
/// outline.
void refuse_unknown_words(Json region, std::string& complaint);

/// The same for the outermost object of a file of a tree of primitives.
void refuse_unknown_words_of_tree(Json root, std::string& complaint);

}  // namespace lekalo::verify
