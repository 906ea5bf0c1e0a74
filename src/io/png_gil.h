#pragma once

// The one place that says how we take Boost.GIL's PNG support.

#ifndef BOOST_GIL_IO_ENABLE_GRAY_ALPHA
#define BOOST_GIL_IO_ENABLE_GRAY_ALPHA
#endif

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wclobbered"
#include <boost/gil.hpp>
#include <boost/gil/extension/io/png.hpp>
#include <boost/gil/extension/toolbox/color_spaces/gray_alpha.hpp>
#pragma GCC diagnostic pop
