"""The OpenAPI description of the server, as far as its test needs it: operations, and checks of answers against it."""
import json
import os

import jsonschema

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
FILE = os.path.join(SOURCE, "queries", "server", "openapi.json")
METHODS = ("get", "put", "post", "delete", "patch", "head", "options")


def as_json_schema(schema):
    """A schema of OpenAPI 3.0 in the words of JSON Schema: there `nullable` is a type."""
    if isinstance(schema, list):
        return [as_json_schema(each) for each in schema]
    if not isinstance(schema, dict):
        return schema
    result = {name: as_json_schema(value) for name, value in schema.items() if name != "nullable"}
    if schema.get("nullable"):
        return {"anyOf": [{"type": "null"}, result]}
    return result


class ApiDescription:
    def __init__(self):
        with open(FILE, encoding="utf-8") as file:
            self.content = json.load(file)
        schemas = as_json_schema(self.content["components"]["schemas"])
        self._definitions = {"components": {"schemas": schemas}}

    def operations(self):
        """All pairs of method and path."""
        return {(method.upper(), path) for path, item in self.content["paths"].items() for method in item
                if method in METHODS}

    def operation(self, method, path):
        return self.content["paths"][path][method.lower()]

    def query_parameters(self, method, path):
        """The names that may stand after `?`."""
        return [each["name"] for each in self.operation(method, path).get("parameters", []) if each["in"] == "query"]

    def response(self, method, path, status):
        """What an operation says about a status; None if it does not have it."""
        found = self.operation(method, path)["responses"].get(str(status))
        if found is not None and "$ref" in found:
            found = self.content["components"]["responses"][found["$ref"].rpartition("/")[2]]
        return found

    def errors_of_schema(self, schema, value):
        """What is wrong with a JSON value, in words."""
        validator = jsonschema.Draft7Validator({**as_json_schema(schema), **self._definitions})
        return [f"{'/'.join(str(each) for each in error.absolute_path)}: {error.message[:300]}"
                for error in validator.iter_errors(value)]

    def errors_of_named(self, name, value):
        return self.errors_of_schema({"$ref": f"#/components/schemas/{name}"}, value)

    def errors_of_answer(self, response, answer):
        """What in an answer differs from the description of its status."""
        errors = [f"the header {name} is missing" for name, header in response.get("headers", {}).items()
                  if header.get("required") and name.lower() not in answer.headers]
        content = response.get("content")
        if content is None:
            return errors + (["a body where none is described"] if answer.body else [])
        kind = answer.headers.get("content-type", "").split(";")[0]
        if kind not in content:
            return errors + [f"content of type '{kind}'; expected {' or '.join(content)}"]
        if kind == "application/json":
            errors += self.errors_of_schema(content[kind]["schema"], answer.json)
        return errors
