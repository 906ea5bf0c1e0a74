#pragma once

namespace split_mapf::python {

/// From now on the package's exceptions come to Python as the classes of
/// python/split_mapf/errors.py that have their names. To be called once, when the module is loaded.
void translateErrors();

}  // namespace split_mapf::python
