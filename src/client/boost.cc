// Boost.Asio and Boost.Beast, but for their templates: compiled here, once for all who include
// them.
#include <boost/asio/impl/src.hpp>
#include <boost/beast/src.hpp>
