"""Plans as orders of VDA 5050: their form, their rules, refusals."""

import copy
import json
import os
import unittest

from command import CommandTest

try:
    import jsonschema
except ImportError:  # only the form is not checked then
    jsonschema = None

ROWS = ["....", ".@..", "...."]
WAYS = [((0, 0), (3, 2)), ((3, 0), (0, 2))]


def load_schema():
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "vda5050_order.schema.json")
    with open(path, encoding="ascii") as file:
        return json.load(file)


class Vda5050Test(CommandTest):
    def setUp(self):
        super().setUp()
        self.write_problem("p", ROWS, WAYS)
        self.planned = self.plan(0, "p")

    def convert(self, *options, code=0):
        return self.expect(code, "convert", *self.files("p"), "--plan", "p.json", "--export",
                           "vda5050", *options)

    def orders(self, *options):
        return json.loads(self.convert(*options).stdout)

    @unittest.skipUnless(jsonschema, "python3-jsonschema is not here")
    def test_orders_have_the_published_form(self):
        schema = load_schema()
        jsonschema.Draft7Validator.check_schema(schema)
        validator = jsonschema.Draft7Validator(schema)
        orders = self.orders()
        self.assertEqual(len(orders), 2)
        for order in orders:
            self.assertEqual([error.message for error in validator.iter_errors(order)], [])
        # The schema can refuse.
        wrong = copy.deepcopy(orders[0])
        wrong["nodes"][0]["sequenceId"] = 1
        wrong["edges"][0]["maximumSpeed"] = 1
        del wrong["orderUpdateId"]
        self.assertEqual(len(list(validator.iter_errors(wrong))), 3)

    def test_orders_lead_along_the_paths_in_metres(self):
        for robot, order in enumerate(self.orders("--resolution", "0.5", "--map-id", "hall")):
            self.assertEqual(order["serialNumber"], "r%d" % robot)
            path = self.planned["paths"][robot]
            visits = [cell for at, cell in enumerate(path) if at == 0 or cell != path[at - 1]]
            places = [node["nodePosition"] for node in order["nodes"]]
            self.assertEqual([[place["x"], place["y"]] for place in places],
                             [[0.5 * x + 0.25, 0.5 * (2 - y) + 0.25] for x, y in visits])
            self.assertEqual({place["mapId"] for place in places}, {"hall"})
            ids = [node["nodeId"] for node in order["nodes"]]
            self.assertEqual(len(set(ids)), len(ids))
            self.assertEqual([node["sequenceId"] for node in order["nodes"]],
                             list(range(0, 2 * len(ids), 2)))
            for index, edge in enumerate(order["edges"]):
                self.assertEqual(edge["sequenceId"], 2 * index + 1)
                self.assertEqual([edge["startNodeId"], edge["endNodeId"]], ids[index:index + 2])
                self.assertEqual(edge["released"], order["nodes"][index + 1]["released"])

    def test_the_base_is_what_needs_no_other_robot(self):
        for ahead in (1, 2, 50):
            with self.subTest(ahead=ahead):
                cells = []
                for order in self.orders("--release-ahead", ahead):
                    released = [node["released"] for node in order["nodes"]]
                    base = released.count(True)
                    self.assertEqual(released, [True] * base + [False] * (len(released) - base))
                    self.assertTrue(1 <= base <= 1 + ahead)
                    cells += [node["nodeDescription"] for node in order["nodes"][:base]]
                # Nobody has to wait, so no cell is in two bases.
                self.assertEqual(len(set(cells)), len(cells))

    def test_lies_where_the_map_lies(self):
        self.write("m.pgm", "P2 4 3 255\n" + "254 " * 5 + "0 " + "254 " * 6)
        self.write("m.yaml", "image: m.pgm\nresolution: 0.5\norigin: [10, 20, 1.5707963267948966]\n"
                   "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")
        result = self.expect(0, "convert", "--map", "m.yaml", "--scen", "p.scen", "--plan",
                             "p.json", "--export", "vda5050")
        place = json.loads(result.stdout)[0]["nodes"][0]["nodePosition"]
        # Cell (0, 0) is the top left one: 0.25 m along, 1.25 m up, turned by a quarter.
        self.assertAlmostEqual(place["x"], 10 - 1.25)
        self.assertAlmostEqual(place["y"], 20 + 0.25)

    def test_writes_a_file(self):
        self.convert("--output", "orders.json")
        self.assertEqual(len(self.read_json("orders.json")), 2)

    def test_refuses_what_does_not_go_together(self):
        files = self.files("p")
        self.expect_refusal(["--plan", "--export"], "convert", *files, "--plan", "p.json")
        self.expect_refusal(["--export", "--plan"], "convert", *files, "--export", "vda5050")
        self.expect_refusal("'xml'", "convert", *files, "--plan", "p.json", "--export", "xml")
        self.expect_refusal("--agents", "convert", *files, "--plan", "p.json", "--export",
                            "vda5050", "--agents", 1)
        self.expect_refusal("release", "convert", *files, "--plan", "p.json", "--export",
                            "vda5050", "--release", 2)
        self.planned["paths"][0] = self.planned["paths"][0][:1] + self.planned["paths"][0][2:]
        self.write("p.json", json.dumps(self.planned))
        self.expect_refusal("not valid", "convert", *files, "--plan", "p.json", "--export",
                            "vda5050")


if __name__ == "__main__":
    unittest.main()
