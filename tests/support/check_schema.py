#!/usr/bin/env python3
"""check_schema.py SCHEMA FILE...: the first objection to each file, or "ok"; a line each."""
import json
import sys

import jsonschema

with open(sys.argv[1], encoding="utf-8") as schema_file:
    schema = json.load(schema_file)
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
for path in sys.argv[2:]:
    with open(path, encoding="utf-8") as file:
        objection = next(validator.iter_errors(json.load(file)), None)
    print("ok" if objection is None else "/".join(map(str, objection.absolute_path)) + ": " + objection.validator)
