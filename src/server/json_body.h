// Reading what a client sent: a JSON object with known keys.
#ifndef UNDERSTUDY_SERVER_JSON_BODY_H_
#define UNDERSTUDY_SERVER_JSON_BODY_H_

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace understudy::server {

// The body's object, or one line that says why there is none.
std::variant<nlohmann::json, std::string> ReadObject(std::string_view body);

// The same where these keys only may be in it.
std::variant<nlohmann::json, std::string> ReadObject(std::string_view body,
                                                     const std::vector<std::string>& keys);

// "" when the object has these keys only, else what is wrong.
std::string UnknownKey(const nlohmann::json& object, const std::vector<std::string>& keys);

// `"name": expected what, got ...`. Of what was found only so much that a line can hold it.
std::string Expected(std::string_view name, const std::string& what, const nlohmann::json& found);

// A value for a message: what is not UTF-8 is replaced, what is long is cut.
std::string Shown(const nlohmann::json& value);

// "\"press\", \"hold\""
std::string Listed(const std::vector<std::string>& words);

// A number within ±most, or NaN if the value is none.
double NumberWithin(const nlohmann::json& value, double most);

// The seconds of an order, `otherwise` where it names none, NaN for what is no time.
double SecondsOf(const nlohmann::json& object, double most, double otherwise = 0);

// Three numbers within ±most under `key`, or one line that says what was expected. `what`: "three
// numbers in N".
std::variant<Eigen::Vector3d, std::string> ReadVector(const nlohmann::json& object,
                                                      const std::string& key, double most,
                                                      const std::string& what);

}  // namespace understudy::server

#endif  // UNDERSTUDY_SERVER_JSON_BODY_H_
