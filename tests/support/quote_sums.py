"""Reckons a quote's CSV again as a person with a spreadsheet would, and says what differs.

    quote_sums.py quote.csv DECIMALS
"""

import csv
import sys
from decimal import ROUND_HALF_UP, Decimal

rows = list(csv.DictReader(open(sys.argv[1], newline="", encoding="utf-8")))
last = Decimal(1).scaleb(-int(sys.argv[2]))


def reckoned(row):
    return (Decimal(row["quantity"]) * Decimal(row["rate"]) / Decimal(row["per"])).quantize(last, ROUND_HALF_UP)


faults = [f"row {i + 2}: {row['amount']} is to be {reckoned(row)}" for i, row in enumerate(rows)
          if row["row"] in ("line", "margin", "tax") and Decimal(row["amount"]) != reckoned(row)]
amounts = {row["row"]: Decimal(row["amount"]) for row in rows if row["row"] != "line"}
lines = [Decimal(row["amount"]) for row in rows if row["row"] == "line"]
if sum(lines) != amounts["sum"]:
    faults.append(f"the lines make {sum(lines)} and the sum is {amounts['sum']}")
if amounts["sum"] + amounts["margin"] + amounts["tax"] != amounts["total"]:
    faults.append(f"the total is {amounts['total']}")
bases = {row["row"]: Decimal(row["quantity"]) for row in rows if row["row"] in ("margin", "tax")}
if bases["margin"] != amounts["sum"] or bases["tax"] != amounts["sum"] + amounts["margin"]:
    faults.append("margin or tax is of another sum")
print("\n".join(faults) or f"{len(lines)} lines, total {amounts['total']}")
sys.exit(1 if faults else 0)
