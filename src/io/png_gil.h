#pragma once

// The one place that says how we take Boost.GIL's PNG support.

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wclobbered"
#include <boost/gil.hpp>
#include <boost/gil/extension/io/png.hpp>
#pragma GCC diagnostic pop
