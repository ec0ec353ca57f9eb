// Figures of drivers, so that one that comes back later, or loses a frame more, is noticed. They are rows of
// tests/drivers/figures/KIND.csv: "driver,case,figures".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fencepost::test {

/// Compares with the row of the driver's table. Only on purpose: FENCEPOST_GOLDEN=FOLDER writes tables anew there.
/// `columns` says what the figures are.
void expect_figures(std::string_view driver, std::string_view case_name, const std::string& figures,
                    std::string_view columns);

/// Rows of all tables whose case begins so.
std::size_t rows_of_figures(std::string_view beginning_of_case = {});

}  // namespace fencepost::test
