#include "mesh_formats/obj/obj_statement.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace mesh_formats {

namespace {

using ObjKeyword = std::pair<std::string_view, ObjStatement>;

// All of version 3.0 of the format, and what older versions called otherwise. Frequent ones first.
constexpr ObjKeyword kObjKeywords[] = {
    {"v", ObjStatement::vertex},
    {"f", ObjStatement::face},
    {"vn", ObjStatement::normal},
    {"vt", ObjStatement::texture_coordinates},
    {"s", ObjStatement::display},
    {"g", ObjStatement::group},
    {"usemtl", ObjStatement::display},
    {"o", ObjStatement::object},
    {"l", ObjStatement::line},
    {"p", ObjStatement::point},
    {"mtllib", ObjStatement::display},
    {"fo", ObjStatement::face},
    {"mg", ObjStatement::display},
    {"bevel", ObjStatement::display},
    {"c_interp", ObjStatement::display},
    {"d_interp", ObjStatement::display},
    {"lod", ObjStatement::display},
    {"maplib", ObjStatement::display},
    {"usemap", ObjStatement::display},
    {"shadow_obj", ObjStatement::display},
    {"trace_obj", ObjStatement::display},
    {"vp", ObjStatement::free_form},
    {"cstype", ObjStatement::free_form},
    {"deg", ObjStatement::free_form},
    {"bmat", ObjStatement::free_form},
    {"step", ObjStatement::free_form},
    {"curv", ObjStatement::free_form},
    {"curv2", ObjStatement::free_form},
    {"surf", ObjStatement::free_form},
    {"parm", ObjStatement::free_form},
    {"trim", ObjStatement::free_form},
    {"hole", ObjStatement::free_form},
    {"scrv", ObjStatement::free_form},
    {"sp", ObjStatement::free_form},
    {"end", ObjStatement::free_form},
    {"con", ObjStatement::free_form},
    {"ctech", ObjStatement::free_form},
    {"stech", ObjStatement::free_form},
    {"bsp", ObjStatement::free_form},
    {"bzp", ObjStatement::free_form},
    {"cdc", ObjStatement::free_form},
    {"cdp", ObjStatement::free_form},
    {"res", ObjStatement::free_form},
};

bool is_keyword_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

}  // namespace

ObjStatement obj_statement(std::string_view keyword) {
  const auto* const found = std::find_if(std::begin(kObjKeywords), std::end(kObjKeywords),
                                         [=](const ObjKeyword& row) { return row.first == keyword; });
  return found == std::end(kObjKeywords) ? ObjStatement::unknown : found->second;
}

bool is_obj_keyword(std::string_view word) {
  return !word.empty() && is_keyword_letter(word.front()) &&
         std::all_of(word.begin(), word.end(), [](char c) { return is_keyword_letter(c) || (c >= '0' && c <= '9'); });
}

}  // namespace mesh_formats
