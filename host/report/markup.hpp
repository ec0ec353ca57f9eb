// Text and numbers on their way into HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace fencepost::host::markup {

/// For element content and quoted attributes alike. Control characters and bytes that are not UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

/// An SVG coordinate, two decimals, never "-0.00".
std::string px(double value);

/// Fixed decimals, a true minus sign for display; an en dash when not finite.
std::string figure(double value, int decimals);

/// Letters, digits and '-' only: usable as a class or an id.
std::string slug(std::string_view text);

}  // namespace fencepost::host::markup
